#!/usr/bin/env bash
# The kernel's inner loops are vectors of their instruction set's width. A sanitizer's checks stand in their way.
. tests/e2e/lib.sh

case $bin in
    */sanitize-*) tests=1; echo 'ok 1 - kernel__compiled__is_vectorised # SKIP a sanitized build' ;;
    *) check 'kernel__compiled__is_vectorised' scripts/vectorised.sh "$bin/../obj" ;;
esac
end_of_tests
