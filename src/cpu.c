/* Run-time choice between the builds of the filter's kernel, and the number of threads worth starting.
 *
 * What is asked for here must match the -m flags of the Makefile: a machine with AVX-512F alone gets the AVX2 build.
 */
#include "cpu.h"

#include <sched.h>

bool cpu_isa_supported(enum cpu_isa isa)
{
    __builtin_cpu_init();
    switch (isa) {
    case CPU_ISA_AUTO:
        return true;
    case CPU_ISA_SSE2:
        return __builtin_cpu_supports("sse2");
    case CPU_ISA_AVX2:
        return __builtin_cpu_supports("avx2");
    case CPU_ISA_AVX512:
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
    case CPU_ISA_COUNT:
        break;
    }
    return false;
}

enum cpu_isa cpu_isa_best(void)
{
    if (cpu_isa_supported(CPU_ISA_AVX512))
        return CPU_ISA_AVX512;
    return cpu_isa_supported(CPU_ISA_AVX2) ? CPU_ISA_AVX2 : CPU_ISA_SSE2;
}

int cpu_count(void)
{
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) != 0)
        return 1;
    int count = CPU_COUNT(&set);
    return count > 0 ? count : 1;
}
