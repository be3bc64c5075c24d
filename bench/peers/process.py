# SPDX-License-Identifier: BSD-3-Clause
"""Runs one program on some of the cores for some of the time."""
import os
import signal
import subprocess
import tempfile
import time
from dataclasses import dataclass


class Failure(Exception):
    """What to say of a program that gave no result."""


@dataclass(frozen=True)
class Finished:
    output: str
    seconds: float
    processor_seconds: float
    peak_bytes: int  # of the largest process


def run(command, threads, timeout):
    """Runs the command on the first cores that this process may use; out of time, it is ended with its children."""
    cores = sorted(os.sched_getaffinity(0))[:threads]
    environment = {**os.environ, "OMP_NUM_THREADS": str(threads)}
    with tempfile.TemporaryFile() as output:
        begin = time.monotonic()
        try:
            process = subprocess.Popen(command, stdout=output, stderr=subprocess.STDOUT, env=environment,
                                       start_new_session=True, preexec_fn=lambda: os.sched_setaffinity(0, cores))
        except FileNotFoundError:
            raise Failure(f"{command[0]}: not there; was a library missing when it was to be built?") from None
        usage = _wait(process, timeout)
        seconds = time.monotonic() - begin
        output.seek(0)
        text = output.read().decode(errors="replace")
    if process.returncode != 0:
        last = (text.strip().splitlines() or ["no output"])[-1]
        raise Failure(f"failed: {last[:100]}")
    return Finished(text, seconds, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024)


def _wait(process, timeout):
    def out_of_time(_signal, _frame):
        raise TimeoutError

    previous = signal.signal(signal.SIGALRM, out_of_time)
    signal.setitimer(signal.ITIMER_REAL, timeout)
    try:
        _, status, usage = os.wait4(process.pid, 0)
    except BaseException as interruption:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        if isinstance(interruption, TimeoutError):
            raise Failure(f"> {timeout:.0f} s") from None
        raise
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, previous)
    process.returncode = os.waitstatus_to_exitcode(status)
    return usage
