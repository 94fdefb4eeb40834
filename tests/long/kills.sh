#!/usr/bin/env bash
# Kills either side or the launcher of a coupled run at random times, again and again, and goes on each time; then compares
# every dataset with an undisturbed run's.
#   tests/long/kills.sh [KILLS]           50 if not given: some minutes
#   CAV_SEED=N tests/long/kills.sh        the times of an earlier run, as far as the machine lets them
set -euo pipefail
cd "$(dirname "$0")/../.."
export CAV_KILLS=${1:-50}
exec cargo test --release --test reliability -- --ignored --exact --nocapture long::killed_over_and_over
