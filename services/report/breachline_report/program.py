"""The program `report`: its arguments, its exit codes, and the order of the chapters."""
from __future__ import annotations

import argparse
import os
import subprocess
import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import Any

from breachline import plot
from breachline.faults import BreachlineError
from breachline.plot import Figure

from .accuracy_page import write_accuracy_page
from .chapters import Choice, Material, assessment, checklist, failure_modes, flow, ground, inputs, mesh, methods, motion, numbers, release, runout, \
    shaking, soil_elements, stability, variants
from .document import Document, Table
from .ended import verdict_of
from .front import front_of
from .measures import Measures
from .page import as_html
from .paper import Paper, paper_for
from .run import Run, mpm, read_run, service_program


def _add_companion(folder: Path, paper: Paper | None, document: Document) -> None:
    """Adds another run's runouts, grounds and variants under its name."""
    run = read_run(folder)
    of, other = Material(run, paper, Measures(run, paper), Choice()), Document(run.title)
    for figure in [each for each in document.figures if each.name == runout.runout_figure]:
        for series in runout.runout_curves(run):
            series.name = f"{run.name}, {series.name}"
            figure.chart.series.append(series)
    ground.add(of, other)
    variants.add(of, other)
    if not other.chapters:
        document.leave_out(f"variants of {folder}", "its study has none")
    for chapter in other.chapters:
        chapter.title, chapter.text = f"{chapter.title}: {run.name}", f"{run.title}. {chapter.text}"
        named: list[Figure | Table] = [*chapter.figures, *chapter.tables]
        for each in named:
            each.name += f"_{run.name}"
        document.add(chapter)


def document_of(run: Run, choice: Choice) -> Document:
    paper = paper_for(run.scene["name"])
    of, asked = Material(run, paper, Measures(run, paper), choice), inputs.Inputs(run)
    document = Document(run.title, front_of(run, paper, asked.breach_width), verdict_of(run))
    assessment.add(of, document)
    inputs.add(asked, document)
    stability.add(of, document)
    failure_modes.add(of, document)
    soil_elements.add(of, document)
    if run.is_static:
        document.leave_out("motion, course of the finite elements, meshes and transfers", "the scene is static: it has no FEM")
    else:
        for add in (motion.add, motion.add_several, shaking.add, mesh.add, runout.add_transfer):
            add(of, document)
    if run.first(mpm):
        runout.add(of, document)
        release.add(of, document, asked.breach_width)
        for add in (ground.add, flow.add, flow.add_outflow):
            add(of, document)
    else:
        document.leave_out("runout, flow and deposit", "the run has no runout")
    for add in (variants.add, checklist.add, methods.add, numbers.add):
        add(of, document)
    for folder in choice.companions:
        _add_companion(folder, paper, document)
    inputs.add_annex(asked, document)
    return document


def _publish(file: Path, content: str | bytes) -> None:
    """Whole or not at all."""
    with NamedTemporaryFile(dir=file.parent, prefix=f".{file.name[:40]}-", delete=False) as partial:
        partial.write(content.encode() if isinstance(content, str) else content)
    os.chmod(partial.name, 0o644)
    os.replace(partial.name, file)


def _publish_figures(document: Document, folder: Path) -> None:
    """Each as SVG, PNG and CSV."""
    folder.mkdir(parents=True, exist_ok=True)
    for each in document.figures:
        _publish(folder / f"{each.name}.svg", document.svg(each))
        _publish(folder / f"{each.name}.png", each.png())
        _publish(folder / f"{each.name}.csv", each.csv())


def write_report(document: Document, page: Path, alone: bool) -> None:
    """With files of figures and tables in a folder beside it, unless it is to be alone."""
    if page.is_dir():
        raise OSError(f"{page}: is a folder; give the page's file name")
    folder = page.parent / f"{page.stem}_files"
    if not alone:
        _publish_figures(document, folder)
        for table in document.tables:
            _publish(folder / f"{table.name}.csv", table.csv())
    _publish(page, as_html(document, "" if alone else folder.name))


def guarded(source: Path, work: Callable[[], None]) -> int:
    """The exit code (core/fault/fault.hpp), after a line on what is wrong."""
    try:
        work()
        return 0
    except BreachlineError as error:
        code, message = 65, str(error)
    except KeyError as error:  # of a document
        code, message = 65, f"{source}: a file of the run has no entry {error}; run its phases again with this version"
    except ValueError as error:  # numbers that cannot be drawn
        code, message = 65, f"{source}: {error}"
    except OSError as error:
        code, message = 74, str(error)
    except MemoryError:
        code, message = 75, "not enough memory"
    except Exception as error:  # pylint: disable=broad-except
        code, message = 70, f"internal fault: {type(error).__name__}: {error}"
    print(f"report: {message}", file=sys.stderr)
    return code


def _numbers(text: str) -> list[float]:
    return [float(each) for each in text.split(",")]


def _folders(text: str) -> list[Path]:
    return [Path(each) for each in text.split(",")]


class _Version(argparse.Action):
    """That of the service's program beside this one."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        said = subprocess.run([service_program(), "--version"], capture_output=True, text=True, check=True).stdout
        print("report " + said.split(" ", 1)[1].rstrip())
        parser.exit()


class _Help(argparse.RawDescriptionHelpFormatter):
    """As the other programs print it."""

    def __init__(self, prog: str) -> None:
        super().__init__(prog, max_help_position=30)
        self._action_max_length = 28

    def add_usage(self, usage: str | None, actions: Iterable[argparse.Action], groups: Iterable[Any], prefix: str | None = None) -> None:
        super().add_usage(usage, actions, groups, "Usage: ")

    def start_section(self, heading: str | None) -> None:
        super().start_section({"positional arguments": "Positionals", "options": "Options"}.get(heading or "", heading))


def _parser(usage: str, purpose: str, more: str = "") -> argparse.ArgumentParser:
    return argparse.ArgumentParser(usage.split(" [")[0], usage=usage, description=purpose, epilog=more, formatter_class=_Help)


def _whole_run(arguments: list[str]) -> int:
    words = {**{word: purpose for word, (purpose, _) in _of_one_phase.items()}, "accuracy": _accuracy_purpose}
    parser = _parser("report [OPTIONS] RUN | SUBCOMMAND", "A run as one HTML page with its figures (SVG, PNG) and their data (CSV)",
                     "Subcommands:\n" + "\n".join(f"  {word:<28}{purpose}" for word, purpose in words.items()))
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version and exit")
    parser.add_argument("run", type=Path, metavar="RUN", help="folder of breach export, or with one folder per phase")
    parser.add_argument("--output", type=Path, required=True, metavar="PAGE", help="the page, F.html; figures and data go to F_files")
    parser.add_argument("--snapshots", type=_numbers, default=[], metavar="TIMES", help="times of contours and meshes [s]: 11,13")
    parser.add_argument("--transfers", type=_numbers, default=[], metavar="TIMES", help="transfer times of the geometries [s]: 13,16")
    parser.add_argument("--element-tests", type=Path, metavar="FOLDER", help="of fem_solver element-test: strength of the scene's soils")
    parser.add_argument("--companions", type=_folders, default=[], metavar="RUNS",
                        help="other runs: their runouts in the figure, their variants behind those of this one")
    parser.add_argument("--alone", action="store_true", help="the page only, without files of its figures and their data")
    asked = parser.parse_args(arguments)
    if asked.output.suffix.lower() == ".pdf":
        page = asked.output.with_suffix(".html")
        parser.error(f"argument --output: names a PDF, and the report is HTML; write {page} and then: weasyprint {page} {asked.output}")
    return guarded(asked.run, lambda: write_report(
        document_of(read_run(asked.run), Choice(asked.snapshots, asked.transfers, asked.companions, asked.element_tests)), asked.output, asked.alone))


def _one_phase(word: str, arguments: list[str]) -> int:
    purpose, write = _of_one_phase[word]
    parser = _parser(f"report {word} [OPTIONS] FOLDER", purpose)
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="output folder of the phase")
    parser.add_argument("--output", type=Path, required=True, metavar="FIGURES", help="folder for figures, made if absent")
    asked = parser.parse_args(arguments)
    return guarded(asked.folder, lambda: write(asked.folder, asked.output))


def _accuracy(arguments: list[str]) -> int:
    parser = _parser("report accuracy [OPTIONS] TABLES ...", _accuracy_purpose)
    parser.add_argument("tables", type=Path, nargs="+", metavar="TABLES", help="what breach accuracy --of RUN --json printed, one file each")
    parser.add_argument("--output", type=Path, required=True, metavar="PAGE", help="the page (Markdown); figures and data go to a folder of its name")
    asked = parser.parse_args(arguments)
    return guarded(asked.output, lambda: write_accuracy_page(asked.tables, asked.output))


def main() -> int:
    word, rest = sys.argv[1] if len(sys.argv) > 1 else "", sys.argv[2:]
    if word == "accuracy":
        return _accuracy(rest)
    return _one_phase(word, rest) if word in _of_one_phase else _whole_run(sys.argv[1:])


_accuracy_purpose = "Page of accuracy studies, with error against CPU seconds"
_of_one_phase: dict[str, tuple[str, Callable[[Path, Path], None]]] = {
    "element-test": ("Figures of fem_solver element-test", lambda folder, output: plot.write_figures(output, plot.element_test_figures(folder))),
    "stability": ("Figures of lem_tool", lambda folder, output: plot.write_figures(output, plot.stability_figures(folder))),
    "transfer": ("Figures of transfer_tool, before and after side by side", plot.write_transfer_figures)}
