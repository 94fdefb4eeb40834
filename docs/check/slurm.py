"""What `sbatch` and `scancel` are for the code of pages: a cluster with room for one job, of one process, on this machine.

    slurm.py sbatch FILE     starts the job script if none has been started here, else leaves it in the queue; says its number
    slurm.py scancel JOB     ends it

Jobs are kept in the working directory, as `.slurm-JOB`: the process, 0 in the queue.
"""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from pathlib import Path

PROCESSES = re.compile(r"--nworkers \d+")


def submit(script: Path) -> int:
    """Starts a job or queues it; its number."""
    jobs = list(Path().glob(".slurm-*"))
    job, process = len(jobs) + 1, 0
    if not jobs:
        text, changed = PROCESSES.subn("--nworkers 1", script.read_text())
        if changed != 1 or "#SBATCH -t " not in text:
            sys.exit(f"sbatch: {script} is no job of workers with a time limit")
        with open(os.devnull, "r+b") as nowhere:
            process = subprocess.Popen(["bash", "-c", text], stdin=nowhere, stdout=nowhere, stderr=nowhere, start_new_session=True).pid
    Path(f".slurm-{job}").write_text(str(process))
    return job


def cancel(job: str) -> None:
    process = int(Path(f".slurm-{job}").read_text())
    if process:
        try:
            os.killpg(process, signal.SIGTERM)
        except ProcessLookupError:
            pass  # It has ended by itself.


if __name__ == "__main__":
    command, argument = sys.argv[1:3]
    if command == "sbatch":
        print(f"Submitted batch job {submit(Path(argument))}")
    else:
        cancel(argument)
