"""Checks that every #include follows the arrows of the house: a room may only include the rooms listed for it, and
only the rooms listed may know an outside library."""
import os
import pathlib
import re
import sys

root = pathlib.Path(os.environ["BREACH_ROOT"])

# room -> rooms it may include (besides itself)
core = {
    "core/fault": set(),
    "core/criteria": {"core/fault"},
    "core/mechanics": set(),
    "core/telemetry": set(),
    "core/materials": {"core/mechanics"},
    "core/scene": {"core/fault", "core/materials", "core/mechanics"},
    "core/exchange": {"core/fault", "core/mechanics"},
    "core/motion": {"core/fault"},
    "core/process": {"core/fault", "core/scene", "core/exchange"},
}
every_core_room = set(core)
arrows = {
    **core,
    "lem_tool": every_core_room,
    "fem_solver": every_core_room,
    "transfer_tool": every_core_room,
    "mpm_solver": every_core_room,
    "services/orchestrator": {"core/criteria", "core/telemetry", "core/fault", "core/scene", "core/exchange"},
    "services/cli": {"core/fault", "core/scene", "core/exchange"},
    "services/report": {"core/criteria", "core/exchange", "core/fault", "core/mechanics", "core/motion"},
}
# outside header -> places (folder or file prefix) that may include it
owners = {
    "hdf5.h": ["core/exchange/"],
    "sqlite3.h": ["services/orchestrator/store/"],
    "httplib.h": ["services/orchestrator/http/", "services/cli/http/"],
    "CLI/": ["core/process/", "services/orchestrator/", "services/cli/", "services/report/"],
    "openssl/": ["core/exchange/", "services/orchestrator/"],
}
include = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')


def room_of(path):
    parts = path.split("/")
    return "/".join(parts[:2]) if parts[0] in ("core", "services") else parts[0]


def main():
    faults = []
    files = 0
    for folder in ("core", "lem_tool", "fem_solver", "transfer_tool", "mpm_solver", "services"):
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
    for room in list(arrows):
        if not (root / room).is_dir():
            faults.append(f"the picture names {room}, which does not exist")
    print("\n".join(faults) or f"{files} files follow the arrows")
    return 1 if faults or files < 20 else 0


if __name__ == "__main__":
    sys.exit(main())
