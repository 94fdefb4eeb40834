#!/usr/bin/env bash
# A coupled run of many steps: memory of both sides, open files, shared memory, and percentiles of the exchange.
#   tests/long/soak.sh [STEPS]            200000 if not given: some minutes
set -euo pipefail
cd "$(dirname "$0")/../.."
export CAV_STEPS=${1:-200000}
exec cargo test --release --test reliability -- --ignored --exact --nocapture \
    long::a_long_coupled_run_holds_no_more_and_more
