#!/usr/bin/env bash
# docs/trade.csv, docs/trade.png and the tables of docs/accuracy.md: see scripts/trade.py, whose libraries come from PyPI
# into build/trade-python. An hour and a half on two cores.
set -eu
python=build/trade-python
[ -e $python/done ] || {
    python3 -m venv $python
    $python/bin/pip -q install numpy OpenEXR pyoidn matplotlib flip-evaluator
    touch $python/done
}
exec $python/bin/python scripts/trade.py "$@"
