"""What the stand-in phases compute: known functions of the completed scene alone, used by them (stand_in.py) and by the
answer (answer.py). No number here means anything; each depends on every entry that its phase is meant to read.

Entries that make a phase end otherwise:

    /lem/slices                  13: the stability analysis breaks down (70)
    /fem/least_jacobian_ratio    other than 0.01: the FEM ends entangled at 100 times that, in s
    /fem/newmark_beta            0.45: the FEM has not enough memory (75) at every attempt until the journey's last retry
    /fem/largest_iterations      below 20: the FEM breaks down (70) after a tenth of that, in s
    /transfer/neighbours         13: the transfer breaks down (70)
    /mpm/cfl                     0.7: the MPM breaks down (70); 0.6: its first attempt ends with 75; 0.5: its soil still moves
    /mpm/rest_body_share         0.01: the MPM has a warning; 0.02: it is questionable"""
import zlib

step = 0.1  # of the FEM, s
end = 2.0  # of the FEM, s


def at(scene, pointer, default):
    for key in pointer.strip("/").split("/"):
        if key not in scene:
            return default
        scene = scene[key]
    return scene


def number(low, high, *of):
    """Between low and high with three decimals, pseudo-random and reproducible."""
    return round(low + (high - low) * zlib.crc32(repr(of).encode()) / 2**32, 3)


def soil(scene):
    """A number from the soil's weight."""
    return round(float(at(scene, "/materials/base_soil/density", 0)) * float(at(scene, "/gravity", 9.81)) / 9.81, 3)


def lem(scene):
    """Factor of safety; None: breakdown."""
    slices = at(scene, "/lem/slices", 50)
    return (
        None if slices == 13 else number(0.7, 1.9, "lem", slices, soil(scene), float(at(scene, "/lem/search/minimum_depth", 0.5)))
    )


def fem(scene):
    """(a number for the whole analysis, how it ends, when)"""
    ratio, iterations = at(scene, "/fem/least_jacobian_ratio", 0.01), at(scene, "/fem/largest_iterations", 25)
    beta, stage = at(scene, "/fem/newmark_beta", 0.3025), scene["fem"]["stages"][-1]
    whole = number(
        0,
        50,
        "fem",
        ratio,
        iterations,
        float(at(scene, "/fem/force_tolerance", 1e-6)),
        float(stage["time_step"]),
        len(at(scene, "/fem/surcharge", [])),
        beta,
        soil(scene),
    )
    if beta == 0.45 and "has_memory" not in scene["fem"]:
        return whole, "breakdown", 0
    if iterations < 20:
        return whole, "breakdown", round(iterations / 10, 6)
    if ratio != 0.01:
        return whole, "entangled", round(100 * ratio, 6)
    return whole, "complete", end


def crest(whole, time):
    """The crest's displacement at a time, in m: increases to between 0.5 and 5 m."""
    return round((0.25 + whole / 22) * time, 6)


def energy(whole, time):
    """Its kinetic energy: another number every three steps, so that conditions become true, false and true again."""
    return number(0, 2, "energy", whole, round(time / step) // 3)


def transfer(scene):
    """The transfer's number; None: breakdown."""
    neighbours = at(scene, "/transfer/neighbours", 40)
    return None if neighbours == 13 else number(0, 20, "transfer", neighbours, at(scene, "/transfer/stress", "total"))


def flag(code, severity):
    return {"code": code, "severity": severity, "message": f"what {code} says", "pointer": ""}


def mpm(scene, time, whole, added, shift):
    """The result of a runout from a FEM's snapshot at this time (None: from the section); None: breakdown."""
    cfl, share, size = (
        float(at(scene, f"/mpm/{name}", other)) for name, other in (("cfl", 0.4), ("rest_body_share", 0.005), ("cell_size", 1))
    )
    if cfl == 0.7:
        return None
    regions = scene["mpm"]["runout"]["regions"]
    base = (
        whole + added + number(1, 30, "mpm", cfl, share, len(regions), soil(scene))
        if time is None
        else whole + added + number(1, 30, "mpm", cfl, share, len(regions), soil(scene)) + rise(time)
    )
    runout = round(base + size**2 + 100 * float(at(scene, "/mpm/damping_ratio", 0.1)) + shift, 6)
    moves = cfl == 0.5
    flags = [flag("still_moving", "questionable")] if moves else []
    if share >= 0.01:
        flags.append(flag("overlap", "questionable" if share >= 0.02 else "warning"))
    return {
        "runout": runout,
        "runout_beyond_toe": max(0, round(runout - 40, 6)),
        "runout_largest": round(runout + 7, 6),
        "area_beyond_toe": round(runout / 3, 6),
        "volume_ratio": 1.0,
        "energy": {"numerical": {"share": 0.01}},
        "cpu_seconds": 0.5,
        "at_rest": not moves,
        "ended": "duration" if moves else "at_rest",
        "kinetic_share": 0.001,
        "end_time": round(9 + size, 6),
        "flags": flags,
        "questionable": any(f["severity"] == "questionable" for f in flags),
    }


def rise(time):
    """How much farther a later transfer goes, in m: a plateau from 0.6 to 1.4 s."""
    return 60.0 if 0.6 <= time <= 1.4 else round(30 * time if time < 0.6 else 30 * (2 - time), 6)
