"""Bad scenes and damaged files given to the real phases: exit 65, every fault named, nothing left behind."""
import json
import pathlib
import tempfile

from phases import check, coarse_column, root, run

scene = json.loads((root / "workflows/scenes/column.json").read_text())


def five_faults():
    bad = json.loads(json.dumps(scene))
    bad["materials"]["sand"]["density"] = -1800
    bad["materials"]["sand"]["law"]["nu"] = 0.5
    region = bad["section"]["regions"][0]
    region["polygon"].pop()
    region["material"] = "clay"
    bad["mpm"]["cell_sise"] = bad["mpm"].pop("cell_size")
    return bad


def main(folder):
    bad = folder / "bad.json"
    bad.write_text(json.dumps(five_faults()))
    pointers = ["/materials/sand/density", "/materials/sand/law/nu", "/section/regions/0/polygon",
                "/section/regions/0/material", "/mpm/cell_sise"]
    good = folder / "good.json"
    good.write_text(json.dumps(scene))
    for phase in ("lem_tool", "fem_solver", "transfer_tool", "mpm_solver"):
        arguments = ["--input", good] if phase == "transfer_tool" else []
        done = run(phase, bad, folder / "none", *arguments)
        check(f"{phase} refuses the bad scene with 65", done.returncode == 65, done.stderr[-2000:])
        for pointer in pointers:
            check(f"  and names {pointer}", pointer in done.stderr, done.stderr)
        check("  and leaves nothing", not (folder / "none").exists())

    done = run("fem_solver", good, folder / "fem", *coarse_column, "--set", "/fem/snapshot_times=[0.1]",
               "--set", "/fem/stages/1/duration=0.1")
    check("fem_solver makes a snapshot to damage", done.returncode == 0, done.stderr[-2000:])
    whole = (folder / "fem/snapshot_0.100000.vtkhdf").read_bytes()
    middle = len(whole) // 2
    flipped = whole[:middle] + bytes([whole[middle] ^ 1]) + whole[middle + 1:]
    for name, content in (("truncated", whole[:middle]), ("empty", b""), ("not HDF5", b"scene" * 1000)):
        damaged = folder / "damaged.vtkhdf"
        damaged.write_bytes(content)
        for phase in ("transfer_tool", "mpm_solver"):
            out = folder / f"{phase}_{name}"
            done = run(phase, good, out, *coarse_column, "--input", damaged)
            check(f"{phase} refuses a {name} file with 65", done.returncode == 65, done.stderr[-2000:])
            check("  and names it", "damaged.vtkhdf" in done.stderr, done.stderr)
            check("  and publishes nothing", not list(out.glob("*.vtkhdf")) and not (out / "result.json").exists())
    damaged.write_bytes(flipped)
    done = run("transfer_tool", good, folder / "flip", *coarse_column, "--input", damaged)
    check("one flipped bit is refused or lies in padding", done.returncode in (0, 65), done.stderr[-2000:])

    done = run("mpm_solver", good, folder / "wrong_kind", *coarse_column, "--input", folder / "fem/snapshot_0.100000.vtkhdf")
    check("mpm_solver refuses a FEM snapshot with 65", done.returncode == 65, done.stderr[-2000:])


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        main(pathlib.Path(name))
