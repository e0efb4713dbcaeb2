#!/bin/sh
# Checks that the compiler turned the inner loops of the filter's kernels into vectors: every path of every build divides
# whole vectors of its instruction set (the one division per weight), and none divides single floats; the march takes the
# products of its 16-bit shares by whole vectors, too.
# usage: scripts/vectorised.sh [folder of the objects]
set -eu
objects=${1:-build/obj}
status=0
for isa in sse2 avx2 avx512; do
    case $isa in
    sse2) register=xmm ;;
    avx2) register=ymm ;;
    avx512) register=zmm ;;
    esac
    objdump -d --no-show-raw-insn "$objects/filter_kernel_$isa.o" "$objects/filter_sight_$isa.o" |
        awk -v isa="$isa" -v register="$register" '
            /^[0-9a-f]+ <.*>:$/ { path = substr($2, 2, length($2) - 3); if (path ~ /^((add|see)_(narrow|wide|power|table|gauss)|(march|see|pool)$)/) paths[path] = 0 }
            path !~ /^((add|see)_(narrow|wide|power|table|gauss)|(march|see|pool)$)/ { next }
            $2 ~ /^v?divps$/ && index($0, "%" register) { paths[path]++ }
            $2 ~ /^v?divss$/ { scalar[path]++ }
            path == "march" && $2 ~ /^v?pmulhuw$/ && index($0, "%" register) { products++ }
            END {
                for (path in paths) {
                    count++
                    if (!paths[path] || scalar[path]) {
                        printf "%s: %s is not vectorised\n", isa, path
                        bad = 1
                    }
                }
                if (!products) { printf "%s: the march is not vectorised\n", isa; bad = 1 }
                if (count < 19) { printf "%s: %d paths found, not 19\n", isa, count; bad = 1 }
                exit bad
            }' || status=1
done
[ $status -eq 0 ] && echo "filter kernels: all paths vectorised"
exit $status
