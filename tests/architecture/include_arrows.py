"""Checks every #include: a folder may include only the folders listed for it, only the listed folders may include an outside
library, subfolders depend on each other only in the given order, and no units (a header with its source) include each
other in a circle."""
import os
import pathlib
import re
import sys

sys.setrecursionlimit(10000)

root = pathlib.Path(os.environ["BREACH_ROOT"])

# folder -> folders it may include (besides itself)
core = {
    "core/words": set(),
    "core/phases": set(),
    "core/fault": {"core/words"},
    "core/version": set(),
    "core/command": {"core/fault"},
    "core/criteria": {"core/fault", "core/telemetry", "core/words"},
    "core/mechanics": set(),
    "core/geometry": {"core/mechanics"},
    "core/numerics": set(),
    "core/statistics": {"core/words"},
    "core/telemetry": {"core/fault"},
    "core/materials": {"core/mechanics"},
    "core/grid": {"core/materials"},
    "core/scene": {"core/fault", "core/geometry", "core/grid", "core/materials", "core/mechanics", "core/words"},
    "core/liquefied": {"core/exchange", "core/fault", "core/geometry", "core/materials", "core/mechanics", "core/scene", "core/words"},
    "core/exchange": {"core/fault", "core/mechanics", "core/words"},
    "core/motion": {"core/fault", "core/words"},
    "core/check": {"core/criteria", "core/fault", "core/geometry", "core/materials", "core/mechanics", "core/motion", "core/scene", "core/telemetry", "core/words"},
    "core/process": {"core/check", "core/fault", "core/phases", "core/scene", "core/exchange", "core/telemetry", "core/version"},
}
every_core_room = set(core)
arrows = {
    **core,
    "lem_tool": every_core_room,
    "fem_solver": every_core_room,
    "element_bench": every_core_room,
    "transfer_tool": every_core_room,
    "mpm_solver": every_core_room,
    "services/earthquake": {"core/geometry", "core/mechanics", "core/motion", "core/scene", "core/words"},
    "services/templates": {"services/earthquake", "core/fault", "core/geometry", "core/scene", "core/words"},
    "services/estimate": {"core/geometry", "core/materials", "core/phases", "core/scene"},
    "services/outflow": {"core/exchange", "core/fault", "core/geometry", "core/phases", "core/statistics", "core/words"},
    "services/findings": {"core/fault", "core/motion", "core/phases", "core/statistics", "core/words"},
    "services/orchestrator": {"services/estimate", "services/findings", "services/drawing", "services/import", "services/outflow", "services/templates", "core/check", "core/command", "core/criteria", "core/fault", "core/motion", "core/scene", "core/exchange", "core/phases", "core/statistics", "core/telemetry", "core/version", "core/words"},
    "services/cli": {"services/estimate", "services/findings", "services/drawing", "services/import", "services/templates", "core/check", "core/command", "core/fault", "core/motion", "core/phases", "core/scene", "core/exchange", "core/version", "core/words"},
    "services/import": {"services/earthquake", "services/templates", "core/check", "core/fault", "core/geometry", "core/mechanics", "core/scene", "core/words"},
    "services/drawing": {"core/check", "core/command", "core/exchange", "core/fault", "core/geometry", "core/materials", "core/mechanics", "core/motion", "core/phases", "core/scene", "core/words"},
}
# folder -> its subfolders in order: each may include those before it; files of the folder itself come last.
# Subfolders in one set do not include each other.
floors = {
    "fem_solver": [{"mesh"}, {"model"}, {"solve"}, {"monitors"}],
    "mpm_solver": [{"loops"}, {"body"}, {"measure"}],
    "services/orchestrator": [{"access", "records"}, {"files", "programs"}, {"study", "executors", "store"}, {"uncertainty", "triggers"},
                              {"dispatch", "accuracy", "audit"},
                              {"http"}],
}
# folder -> its headers for others; the rest is private
interfaces = {"services/import": ["services/import/import"],
         "services/drawing": ["services/drawing/section_drawing", "services/drawing/mesh_question"]}
# units in several files: an interface included by its own parts
one_thing = [re.compile(r"core/materials/(norsand|pm4sand)/"), re.compile(r"core/scene/(scene|beds|reader|reading|plausibility|resolution|words)$"),
             re.compile(r"core/check/(check|subjects)$")]
# outside header -> places (folder or file prefix) that may include it
owners = {
    "boost/": ["core/statistics/quantiles.", "core/statistics/sobol."],
    "hdf5.h": ["core/exchange/"],
    "sqlite3.h": ["services/orchestrator/store/"],
    "httplib.h": ["services/orchestrator/http/", "services/cli/http/"],
    "CLI/": ["core/process/", "services/orchestrator/", "services/cli/"],
    "openssl/": ["core/exchange/", "services/orchestrator/access/"],
}
include = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')


def room_of(path):
    parts = path.split("/")
    return "/".join(parts[:2]) if parts[0] in ("core", "services") else parts[0]


def floor_of(room, path):
    """(level, subfolder) of a file within its folder; files outside subfolders are on the last level."""
    rest = path[len(room) + 1:]
    if "/" not in rest:
        return len(floors[room]), "(own files)"
    folder = rest.split("/")[0]
    return next((k for k, folders in enumerate(floors[room]) if folder in folders), None), folder


def floor_fault(room, name, target):
    (here, folder), (there, other) = floor_of(room, name), floor_of(room, target)
    for k, each in ((here, folder), (there, other)):
        if k is None:
            return f"the folder {room}/{each} is not in the picture"
    if folder != other and there >= here:
        return f"{room}: {folder} must not include {other}"
    return None


def circles(arrows_of_units):
    """Strongly connected sets of more than one unit (Tarjan)."""
    index, low, stack, found, on = {}, {}, [], [], set()

    def visit(unit):
        index[unit] = low[unit] = len(index)
        stack.append(unit)
        on.add(unit)
        for other in arrows_of_units.get(unit, ()):
            if other not in index:
                visit(other)
                low[unit] = min(low[unit], low[other])
            elif other in on:
                low[unit] = min(low[unit], index[other])
        if low[unit] == index[unit]:
            circle = []
            while True:
                circle.append(stack.pop())
                on.discard(circle[-1])
                if circle[-1] == unit:
                    break
            if len(circle) > 1:
                found.append(sorted(circle))

    for unit in sorted(arrows_of_units):
        if unit not in index:
            visit(unit)
    return found


def main():
    faults = []
    units = {}
    files = 0
    for folder in ("core", "lem_tool", "fem_solver", "element_bench", "transfer_tool", "mpm_solver", "services"):
        for file in sorted((root / folder).rglob("*.?pp")):
            name = str(file.relative_to(root))
            room = room_of(name)
            files += 1
            if room not in arrows:
                faults.append(f"{name}: the room {room} is not in the picture")
                continue
            for number, line in enumerate(file.read_text().splitlines(), 1):
                match = include.match(line)
                if not match:
                    continue
                target = match.group(1)
                for header, places in owners.items():
                    if (target == header or target.startswith(header)) and not any(name.startswith(p) for p in places):
                        faults.append(f"{name}:{number}: only {places} may include {header}")
                if (root / target).exists():
                    other = room_of(target)
                    if other != room and other not in arrows[room]:
                        faults.append(f"{name}:{number}: {room} must not include {other}")
                    if other != room and other in interfaces and target.rsplit(".", 1)[0] not in interfaces[other]:
                        faults.append(f"{name}:{number}: {target} is not part of the interface of {other}")
                    if other == room and room in floors:
                        fault = floor_fault(room, name, target)
                        if fault:
                            faults.append(f"{name}:{number}: {fault} ({target})")
                    unit, included = name.rsplit(".", 1)[0], target.rsplit(".", 1)[0]
                    if unit != included:
                        units.setdefault(unit, set()).add(included)
    for room in list(arrows):
        if not (root / room).is_dir():
            faults.append(f"the picture names {room}, which does not exist")
    for circle in circles(units):
        if not any(all(whole.match(unit) for unit in circle) for whole in one_thing):
            faults.append("a circle of units: " + ", ".join(circle))
    print("\n".join(faults) or f"{files} files follow the arrows")
    return 1 if faults or files < 20 else 0


if __name__ == "__main__":
    sys.exit(main())
