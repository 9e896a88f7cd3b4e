"""What a whole process costs: CPU seconds, wall seconds, peak resident memory, and the most that its folder held."""

import os
import resource
import subprocess
import sys
import threading
import time


class Failure(Exception):
    """A program that ended with an error, or was stopped for its memory or its time."""


class FolderWatch:
    """Looks at the size of a folder twenty times a second."""

    def __init__(self, folder):
        self.folder, self.most_bytes, self._done = folder, 0, threading.Event()
        self._thread = threading.Thread(target=self._run)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._done.set()
        self._thread.join()

    def _run(self):
        while not self._done.wait(0.05):
            self.most_bytes = max(self.most_bytes, folder_bytes(self.folder))


def folder_bytes(folder):
    total = 0
    for place, _, names in os.walk(folder):
        for name in names:
            try:
                total += os.stat(os.path.join(place, name)).st_blocks * 512
            except FileNotFoundError:  # Removed since it was listed.
                pass
    return total


def touch(size_bytes):
    """Writes to as much memory and gives it back: pages that a virtual machine has returned to its host are made again
    now, and not at the cost of who is measured next."""
    # Another process: what this one had at most counts as the peak of those that it begins.
    code = f"import numpy; numpy.ones({size_bytes}, dtype=numpy.uint8)"
    if size_bytes > 0:
        subprocess.run([sys.executable, "-c", code], check=True)


def run(command, temp_folder, address_space_bytes=None, environment=None):
    """Runs a command to its end. A record of what it cost; raises Failure."""

    def limit():
        if address_space_bytes:
            resource.setrlimit(resource.RLIMIT_AS, (address_space_bytes, address_space_bytes))

    begin = time.monotonic()
    with FolderWatch(temp_folder) as watch:
        process = subprocess.Popen(
            command,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            preexec_fn=limit if address_space_bytes else None,  # Without one no copy of this process is made.
            env={**os.environ, **(environment or {})},
        )
        message = process.stderr.read().decode(errors="replace")
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        last = message.strip().splitlines()[-1] if message.strip() else ""
        raise Failure(f"ended with {process.returncode}: {last}")
    return {
        "cpu_s": usage.ru_utime + usage.ru_stime,
        "wall_s": time.monotonic() - begin,
        "peak_mib": usage.ru_maxrss / 1024.0,
        "temp_bytes": watch.most_bytes,
    }


def wall_of_all(commands):
    """Runs commands at the same time to the end of all; raises Failure."""
    begin = time.monotonic()
    processes = [subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) for command in commands]
    codes = [process.wait() for process in processes]
    if any(codes):
        raise Failure(f"of several at once one ended with {next(filter(None, codes))}")
    return time.monotonic() - begin
