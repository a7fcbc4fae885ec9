"""A tailings slope of PM4Sand on a few large elements: wet, over rock, between free-field columns, shaken. Seconds, not minutes."""
import json

from opensees_models import EMBANKMENT, FOUNDATION, TAILINGS, block, scene, sine, write_motion


def write(folder, duration=3.0, strength=1.0, **fem):
    """strength 1: 0.3 g at 2 Hz."""
    write_motion(folder / "motion.csv", 5e-3, [strength * v for v in sine(duration, 0.5, 5e-3)])
    regions = [
        block("foundation", "foundation", [[0, -4], [60, -4], [60, 0], [48, 0], [24, 0], [0, 0]], [20, 2]),
        block("tailings", "tailings", [[0, 0], [24, 0], [24, 8], [0, 8]], [8, 4]),
        block("embankment", "embankment", [[24, 0], [48, 0], [28, 8], [24, 8]], [8, 4])]
    regions[0]["mesh"]["corners"] = [[0, -4], [60, -4], [60, 0], [0, 0]]
    supports = [{"name": "base", "from": [0, -4], "to": [60, -4], "fixes": "xy"}]
    result = scene("coarse_slope", {"tailings": TAILINGS, "embankment": EMBANKMENT, "foundation": FOUNDATION}, regions,
                   supports, [[0, 8], [24, 8], [48, 0], [60, 0]], "motion.csv", [26, 8], duration,
                   time_step=5e-3, free_field={"width": 3}, force_tolerance=1e-5, **fem)
    (folder / "scene.json").write_text(json.dumps(result, indent=1))
    return folder / "scene.json"
