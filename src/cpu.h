/* What this processor offers. */
#ifndef POVGLOSS_CPU_H
#define POVGLOSS_CPU_H

#include <stdbool.h>

enum cpu_isa { CPU_ISA_AUTO, CPU_ISA_SSE2, CPU_ISA_AVX2, CPU_ISA_AVX512, CPU_ISA_COUNT };

/* Whether code built for that instruction set runs here; AUTO always does. */
bool cpu_isa_supported(enum cpu_isa isa);

/* The widest instruction set that runs here: never AUTO. */
enum cpu_isa cpu_isa_best(void);

/* Processors this process may run on, at least 1. */
int cpu_count(void);

#endif
