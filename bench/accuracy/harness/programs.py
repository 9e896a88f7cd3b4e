"""The programs under test, started as a user would."""

import json
import os
import subprocess
import time


class ProgramError(RuntimeError):
    pass


class Programs:
    """Paths of the built programs; every program runs on one thread, so that --jobs is the load of the machine."""

    def __init__(self, build):
        self.arris_path = os.path.join(build, "bin", "arris")
        self.baseline_path = os.path.join(build, "bin", "bench_baseline")
        for path in (self.arris_path, self.baseline_path):
            if not os.access(path, os.X_OK):
                raise ProgramError(f"{path} is missing; configure with -DARRIS_BENCH=ON and build")

    @staticmethod
    def run(arguments):
        """Output and wall seconds; ProgramError with the program's own message if it fails."""
        start = time.monotonic()
        done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, check=False)
        seconds = time.monotonic() - start
        if done.returncode != 0:
            message = " ".join((done.stderr or done.stdout).split())[:400]
            raise ProgramError(
                f"{os.path.basename(str(arguments[0]))} {arguments[1]}: exit code {done.returncode}: {message}"
            )
        return done.stdout, seconds

    def arris(self, *arguments):
        return self.run([self.arris_path, *arguments])

    def baseline(self, *arguments):
        return self.run([self.baseline_path, *arguments])

    def has_option(self, verb, option):
        """Whether `arris VERB --help` names the option or value."""
        return option in self.arris(verb, "--help")[0]

    def spacing(self, cloud):
        """Spacing that `arris info` estimates."""
        return json.loads(self.arris("info", "--json", cloud)[0])["files"][0]["spacing"]

    def version(self):
        return self.arris("--version")[0].splitlines()[0]
