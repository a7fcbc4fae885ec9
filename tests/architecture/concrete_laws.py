"""No folder outside core/materials names a particular law; others use the interface of every law (traits.hpp, memory.hpp,
state_parameter.hpp). Exceptions: the scene's reader of a law's own entries, and the bench that tests laws."""
import os
import pathlib
import re
import sys

root = pathlib.Path(os.environ["BREACH_ROOT"])
rooms = ("core", "services", "lem_tool", "fem_solver", "element_bench", "transfer_tool", "mpm_solver")
of_laws = ("core/materials/",)
may_name = ("core/scene/read_section.", "core/scene/norsand.", "core/scene/sand.", "element_bench/")

laws = re.search(r"using Law = std::variant<([^>]*)>", (root / "core/materials/law.hpp").read_text()).group(1).replace(",", " ").split()
include = re.compile(r'^\s*#\s*include\s*"(core/materials/[^"]+)"', re.M)
said = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"', re.S)  # for people, not for the compiler


def homes():
    """A law's folder, or its header if it has none."""
    for header in sorted((root / "core/materials").rglob("*.hpp")):
        if any(re.search(rf"^struct {law} \{{", header.read_text(), re.M) for law in laws):
            name = str(header.relative_to(root))
            yield name if name.count("/") == 2 else str(pathlib.Path(name).parent) + "/"


def main():
    places = sorted(homes())
    spaces = "|".join(pathlib.Path(place).name for place in places if place.endswith("/"))
    name = re.compile(rf"\b(?:(?:{'|'.join(laws)})\w*|(?:{spaces})(?=::))")
    faults, allowed, files = [], 0, 0
    for file in sorted(f for room in rooms for f in (root / room).rglob("*.?pp")):
        path = str(file.relative_to(root))
        if path.startswith(of_laws):
            continue
        files += 1
        text = file.read_text()
        named = {target for target in include.findall(text) if target.startswith(tuple(places))} | set(name.findall(said.sub("", text)))
        if path.startswith(may_name):
            allowed += bool(named)
        elif named:
            faults.append(f"{path} names {', '.join(sorted(named))}: ask a question that every law answers")
    print("\n".join(faults) or f"{files} files name none of {', '.join(laws)}; {allowed} that read or test them do")
    return 1 if faults or files < 200 or allowed < 5 or len(places) != len(laws) else 0


if __name__ == "__main__":
    sys.exit(main())
