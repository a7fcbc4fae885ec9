"""Rows of tests that ctest runs under its label `stiff` anyway. What they print as "reached ... allowed ..." is the row;
where a test asserts without numbers, the row says that its assertions hold."""
import dataclasses
import os
import re
import subprocess
import sys

from rows import cpu_of_children, programs, root

REACHED = re.compile(r"^\s*(.+?)\s+reached\s+(\S+?),?\s+allowed\s+(\S+)\s*$", re.M)


@dataclasses.dataclass
class Row:
    name: str
    phase: str
    extreme: str
    right: str
    text: str
    holds: bool
    margin: str
    seconds: float


GTEST = (
    # executable, test, phase, case, what is extreme, what is right
    ("unit_lem", "Extreme.VerticalFaceIsAnalysed", "LEM", "a vertical cut", "ground of 90 degrees", "3.83 c / (gamma H) (Fellenius), within 0.005"),
    ("unit_lem", "Extreme.TwoHundredLayersAreCutAtEveryOne", "LEM", "two hundred layers", "layers 7.5 cm thick", "the F of one layer, within 5e-4"),
    ("unit_lem", "Extreme.GroundDeepUnderWaterHasAFactor", "LEM", "a slope a kilometre under water", "water level 1000 m", "finite, and above 1"),
    ("unit_lem", "Extreme.FrictionlessBesideVeryFrictionalSoilGivesANumberOrSaysWhyNot", "LEM", "no friction beside 89 degrees",
     "phi 0 and 89 degrees in neighbours", "Bishop converges with every m_alpha positive"),
    ("verify_fem_stiff", "Extreme.PoissonsRatioOf04999GivesTheExactColumn", "FEM", "a column of nu 0.4999", "nu 0.4999", "rho g H^2 / 2 M"),
    ("verify_fem_stiff", "Extreme.AspectRatioOfAHundredGivesTheExactColumn", "FEM", "flat elements", "aspect 1:100", "rho g H^2 / 2 M"),
    ("verify_fem_stiff", "Extreme.StiffnessContrastOfAMillionGivesTheExactColumn", "FEM", "soil on rock", "E ratio 1e6 in neighbours",
     "rho g H^2 / 2 M of the soil; the rock adds 3e-6"),
    ("verify_fem_stiff", "Extreme.ATimeStepAHundredTimesTooLargeStaysBounded", "FEM", "steps a hundred times too large",
     "100 times a wave's way through an element", "damped to the static settlement"),
    ("verify_fem_stiff", "Extreme.ASlidingSlopeWithHugeStepsCutsThemOrStopsClearly", "FEM", "a sliding slope in huge steps", "step of 0.5 s, 100 times the usual",
     "cut, or a clear stop; displacement bounded"),
    ("verify_fem_stiff", "Extreme.NothingDriftsInALongRest", "FEM", "a long rest", "100 s, with and without gravity", "no drift"),
    ("verify_fem_stiff", "WetExtreme.PermeabilityOf1e12And1SideBySideStayApart", "FEM", "tight below open soil", "permeability ratio 1e12 in neighbours",
     "undrained below, drained above"),
    ("verify_fem_stiff", "WetExtreme.PoissonsRatioOf04999IsUndrainedExactly", "FEM", "wet soil of nu 0.4999", "nu 0.4999, k 1e-12 m/s", "Terzaghi at time 0"),
    ("verify_fem_stiff", "WetExtreme.WaterAThousandTimesStifferIsUndrainedExactly", "FEM", "stiff water", "K_f 2200 GPa", "Terzaghi at time 0"),
    ("verify_fem_stiff", "WetExtreme.OneElementThickLayersAndAspect100AreUndrained", "FEM", "a wet layer of one element; aspect 1:100", "1 element; 1:100",
     "Terzaghi at time 0"),
    ("verify_fem_stiff", "WetExtreme.ATimeStepAHundredTimesTooLargeStaysBoundedAndEndsDrained", "FEM", "consolidation in huge steps", "T_v 0.5 per step, 100 times the usual",
     "bounded, and drained at the end"),
    ("verify_fem_stiff", "WetExtreme.ThreeGEndsClearly", "FEM", "shaking of 3 g", "peak acceleration 3 g on a wet slope", "an end or a clear stop, all finite"),
    ("verification_transfer", "Extreme.AJumpOfTenThousandTimesBetweenNeighboursStaysFinite", "transfer", "a jump of stress", "1e4 between neighbours",
     "finite, on the yield surface, no swing beyond the jump"),
    ("verification_transfer", "Extreme.OneRowOfOneGaussElementsIsALine", "transfer", "one row of one-point elements", "centres on a line", "linear fields exact to 1e-6"),
    ("verification_transfer", "Extreme.ElementsThatLieOnEachOtherShareTheirGaussPoints", "transfer", "elements on each other", "every centre twice", "linear fields to 1e-5"),
    ("mpm_contact_cases", "Extremes.StiffnessContrastOfOneHundredThousandInOneCellStaysWhole", "MPM", "hard and soft soil in one cell", "E ratio 1e5", "speeds below the guard's"),
    ("mpm_contact_cases", "Extremes.FrictionOfZeroAndOfTenStayWhole", "MPM", "friction of nothing and of ten", "coefficient 0 and 10", "the guard is content"),
    ("mpm_contact_cases", "Extremes.StressFarOutsideYieldIsReturned", "MPM", "stress far outside yield", "1 MPa on soil that bears kPa", "returned; speeds below the guard's"),
    ("mpm_contact_cases", "Extremes.ASinglePointFallsLandsAndStays", "MPM", "a body of one point", "1 point", "g t^2 / 2, then it lies"),
    ("mpm_contact_cases", "Extremes.NothingMovesInAThousandSecondsWithoutGravity", "MPM", "a thousand seconds without gravity", "1000 s", "nothing moves"),
    ("mpm_contact_cases", "Extremes.ATornOffPointOpensNoFurtherThanTheCellsAboutIt", "MPM", "a torn-off point", "strain rate 4/s in free flight", "at most the four cells about it"),
    ("unit_pm4sand_extremes", "Pm4SandExtremes.TenThousandCycles", "FEM", "ten thousand cycles of PM4Sand", "1e4 cycles of 0.02 %", "every call resolved, bounds kept"),
    ("unit_pm4sand_extremes", "Pm4SandExtremes.PressureMayVanishAndComeBack", "FEM", "pressure that vanishes", "p to p_min and back", "every call resolved"),
)

SCRIPTS = (
    ("wet_rock_a_million_times_stiffer_gives_the_exact_column", "wet soil on wet rock", "E ratio 1e6", "Terzaghi undrained, then drained"),
    ("permeability_1e_12_beside_1_gives_the_exact_seepage", "seepage through tight beside open soil", "permeability ratio 1e12 in neighbours", "p and sigma'_v linear in depth"),
    ("tailings_liquefied_from_the_start_stay_so_and_carry_no_more", "quicksand that is shaken", "everything liquefied at t = 0", "p_0 the weight above; no stress comes back"),
    ("sand_without_motion_does_not_drift_in_100_s", "PM4Sand at rest", "100 s under gravity and water", "no drift"),
    ("three_g_on_liquefying_sand_end_clearly", "PM4Sand at 3 g", "peak acceleration 3 g", "an end or a clear stop"),
    ("steps_a_hundred_times_too_large_are_cut_or_end_clearly", "PM4Sand in huge steps", "step of 0.43 s, 86 times the usual", "cut, or a clear stop; at most 5 times the usual displacement"),
    ("a_wet_mesh_that_entangles_ends_with_its_last_good_state", "a wet face that fails", "20 m face of weak soil", "entangled, with its last good state"),
)


def told(done):
    """Text, margin and verdict of what a test printed."""
    numbers = [(what, abs(float(reached)), float(allowed)) for what, reached, allowed in REACHED.findall(done.stdout)]
    ran = "Running 0 tests" not in done.stdout  # GoogleTest is content with a name that no test has
    holds = done.returncode == 0 and ran
    if not numbers:
        said = [line.strip() for line in done.stdout.splitlines() if line.startswith("    ")]
        return (said[-1][:150] if said else "its assertions hold"), "-", holds
    what, reached, allowed = max(numbers, key=lambda each: each[1] / each[2] if each[2] else each[1])
    text = f"{what} {reached:.2g} (allowed {allowed:.1g})" + (f", {len(numbers) - 1} more" if len(numbers) > 1 else "")
    return text, "exact" if reached == 0 else f"{allowed / reached:.3g}", holds


def row_of(command, *about):
    before = cpu_of_children()
    environment = os.environ | {"BREACH_ROOT": str(root), "BREACH_BIN": str(programs)}
    done = subprocess.run(command, capture_output=True, text=True, env=environment)
    text, margin, holds = told(done)
    return Row(*about, text, holds, margin, cpu_of_children() - before)


def rows_of_ctest(asked):
    """Rows whose phase and name contain the words asked for; a test that is not built makes none, and says so."""
    for executable, test, phase, name, extreme, right in GTEST:
        if asked not in f"{phase} {name}":
            continue
        if not (programs / executable).exists():
            print(f"{executable} is not built: no row for {test}", file=sys.stderr)
            continue
        yield row_of([str(programs / executable), f"--gtest_filter={test}"], name, phase, extreme, right)
    for truth, name, extreme, right in SCRIPTS:
        if asked in f"FEM {name}":
            script = root / "tests/verification/fem/extreme_test.py"
            yield row_of([sys.executable, "-B", str(script), truth], name, "FEM", extreme, right)
