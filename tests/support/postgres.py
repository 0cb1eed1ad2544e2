"""A PostgreSQL server with PostGIS for one test: Debian's programs, a cluster of its own in a temporary folder, reached by a socket there."""

import contextlib
import os
import pathlib
import pwd
import shutil
import subprocess
import sys
import tempfile

PROGRAMS = pathlib.Path("/usr/lib/postgresql/15/bin")
EXTENSION = pathlib.Path("/usr/share/postgresql/15/extension/postgis.control")


def skip_without_postgis() -> None:
    """Ends the test with a reason where the server is not installed, or cannot be started."""
    if not (PROGRAMS / "initdb").exists() or not EXTENSION.exists():
        print("skipped: no PostgreSQL 15 with PostGIS (apt install postgresql-15-postgis-3)")
        sys.exit(77)
    if os.geteuid() == 0 and "postgres" not in {user.pw_name for user in pwd.getpwall()}:
        print("skipped: the server does not run as root, and there is no user postgres")
        sys.exit(77)


class Cluster:
    def __init__(self, folder: pathlib.Path, durable: bool):
        self.folder = folder
        self._durable = durable
        # The server refuses to run as root.
        self._as_user = (["setpriv", "--reuid=postgres", "--regid=postgres", "--init-groups", "--reset-env"]
                         if os.geteuid() == 0 else [])
        self._run("initdb", "-D", str(folder / "data"), "-A", "trust", "-U", "postgres", "--no-sync", "-E", "UTF8", "--locale=C")
        self.start()

    def _run(self, program: str, *words: str) -> None:
        # Not into a pipe, which the server would hold open after pg_ctl has ended.
        with open(self.folder / "output", "a") as output:
            done = subprocess.run([*self._as_user, str(PROGRAMS / program), *words], cwd=self.folder, stdin=subprocess.DEVNULL,
                                  stdout=output, stderr=output, timeout=60, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{program} failed: {(self.folder / 'output').read_text()}")

    def start(self) -> None:
        options = f"-k {self.folder} -c listen_addresses='' -c fsync={'on' if self._durable else 'off'}"
        self._run("pg_ctl", "-D", str(self.folder / "data"), "-w", "-l", str(self.folder / "log"), "-o", options, "start")

    def stop(self) -> None:
        """At once, as when its machine fails."""
        self._run("pg_ctl", "-D", str(self.folder / "data"), "-m", "immediate", "-w", "stop")

    def address(self, database: str = "postgres") -> str:
        return f"postgresql://postgres@/{database}?host={self.folder}"

    def query(self, statement: str, database: str = "postgres") -> str:
        """What psql prints for it."""
        return subprocess.run(["psql", "-X", "-q", "-A", "-t", "-v", "ON_ERROR_STOP=1", "-c", statement, self.address(database)],
                              check=True, capture_output=True, text=True, timeout=60).stdout.strip()


@contextlib.contextmanager
def cluster(durable: bool = False):
    """A server that runs; without `durable` its commits do not wait for the disk."""
    skip_without_postgis()
    folder = pathlib.Path(tempfile.mkdtemp(prefix="lapwing-postgres-"))
    if os.geteuid() == 0:
        shutil.chown(folder, "postgres", "postgres")
    folder.chmod(0o755)
    server = Cluster(folder, durable)
    try:
        yield server
    finally:
        with contextlib.suppress(RuntimeError):
            server.stop()
        shutil.rmtree(folder, ignore_errors=True)
