"""Whether pose graphs are settled as well as is known to be possible, beside the certified optima of SE-Sync (Rosen et al. 2019, values of its 2D table).

usage: pose_graphs.py FOLDER; FOLDER holds manhattan.g2o, intel.g2o, MIT.g2o, CSAIL.g2o, ais2klinik.g2o, city10000.g2o; what is not there is passed over.
SE-Sync weighs places alike in both directions and counts |R - R'|^2, which is twice the squared angle where it is small: the edges are written so.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

LAPWING = pathlib.Path(__file__).resolve().parent.parent.parent / "build/release/bin/lapwing"
OPTIMA = {"manhattan": 6.432e3, "intel": 5.235e1, "MIT": 6.115e1, "CSAIL": 3.170e1, "ais2klinik": 1.885e2, "city10000": 6.386e2}


def as_se_sync_counts(line: str) -> str:
    words = line.split()
    if not words or words[0] != "EDGE_SE2":
        return line
    xx, xy, _, yy, _, turn = (float(word) for word in words[6:12])
    place = 2 * (xx * yy - xy * xy) / (xx + yy)
    return " ".join(words[:6]) + f" {place} 0 0 {place} 0 {2 * turn}\n"


def settle(program, text: str) -> dict:
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "graph.g2o")
        path.write_text(text)
        subprocess.run([program, "map", path, "--out", folder], check=True, stdout=subprocess.DEVNULL)
        return json.loads(pathlib.Path(folder, "report.json").read_text())


def measure(program, say, folder) -> list:
    rows = []
    for name, optimum in OPTIMA.items():
        path = pathlib.Path(folder, f"{name}.g2o")
        if not path.exists():
            say(f"graph   {name}: not there")
            continue
        lines = path.read_text().splitlines(keepends=True)
        own, theirs = settle(program, "".join(lines)), settle(program, "".join(as_se_sync_counts(line) for line in lines))
        rows.append({"graph": name, "poses": own["poses"], "squared_error": own["squared_error"], "wall_s": own["wall_s"], "as_se_sync": theirs["squared_error"], "optimum": optimum})
        say(f"graph   {name:10} {own['poses']:6} poses: squared error {own['squared_error']:10.3f} in {own['wall_s']:5.2f} s; as SE-Sync counts {theirs['squared_error']:9.3f} "
            f"({100 * (theirs['squared_error'] / optimum - 1):+.3f} % of its optimum)")
    return rows


if __name__ == "__main__":
    measure(sys.argv[2] if len(sys.argv) > 2 else LAPWING, lambda text: print(text, flush=True), sys.argv[1])
