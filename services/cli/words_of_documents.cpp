// Commands about files of the user: scenes, studies, records and drawings. Called by
// command_line.cpp. new, verify and import send no request; draw and motion ask a server only for
// what the files do not say.
#include "services/cli/commands.hpp"
#include "services/cli/draw.hpp"
#include "services/cli/import.hpp"
#include "services/cli/mirror.hpp"
#include "services/cli/motion.hpp"
#include "services/cli/new_scene.hpp"
#include "services/cli/program.hpp"
#include "services/cli/verify.hpp"

namespace breach::cli {

namespace {

/// A command without requests.
template <class Options>
auto offline(fault::ExitCode (*run)(const Options&, const Console&)) {
    return [run](Server&, const Options& options, const Console& console) {
        return run(options, console);
    };
}

void add_draw(Program& program) {
    const auto& [word, options] =
        program.add<DrawOptions>("draw", "the section of a scene or a study, and what it will cost",
                                 "scene.json --output section.svg", draw);
    word.add_option("SCENE|STUDY", options.document, "scene or study file (JSON)")->required();
    word.add_option("--output", options.picture, "the picture (SVG); without it only the cost");
    word.add_option("--set", options.overrides,
                    "/json/pointer=value, changes the scene; repeatable")
        ->allow_extra_args(false);
    word.add_flag("--mesh", options.mesh, "draw the FEM's mesh, too; made once and kept");
}

void add_motion(Program& program) {
    const auto& [word, options] = program.add<MotionOptions>(
        "motion",
        "measures of a record (PGA, PGV, Arias, MASI, spectrum), or the findings of a study of "
        "several",
        "record.AT2 --scale-to-pga-g 0.3", show_motion);
    CLI::Option_group* what = word.add_option_group("what");
    CLI::Option* file = what->add_option(
        "FILE", options.file, "acceleration: PEER, CSV or two columns; or a folder of them");
    what->add_option("--of", options.run, "instead: the run of a study of several motions");
    what->require_option(1);
    word.add_option("--scale-to-pga-g", options.scale_to_pga_g, "peak acceleration [g]")
        ->check(CLI::PositiveNumber)
        ->needs(file);
    word.add_flag("--corrected", options.corrected, "correct the baseline first")->needs(file);
    CLI::Option* scene =
        word.add_option("--scene", options.scene,
                        "of a folder: print a study that shakes this scene by each record");
    scene->needs(file)->check(CLI::ExistingFile);
    word.add_option("--pga-g", options.pga_g, "with --scene: scaled to each of these, 0.1,0.3")
        ->delimiter(',')
        ->check(CLI::PositiveNumber)
        ->needs(scene);
}

void add_mirror(Program& program) {
    const auto& [word, options] =
        program.add<MirrorOptions>("mirror", "the scene drawn from the other side, with its motion",
                                   "dam.json --output mirrored.json", offline(mirror));
    word.add_option("SCENE", options.scene, "scene file (JSON)")
        ->required()
        ->check(CLI::ExistingFile);
    word.add_option("--output", options.output, "the mirrored scene (JSON); must not exist")
        ->required();
}

/// "!--full" sets the same flag to false, so that the last of the two counts.
void add_verify(Program& program) {
    const auto& [word, options] = program.add<VerifyOptions>(
        "verify", "compare the programs with closed forms, published tables and other programs",
        "--quick --output verification", offline(verify));
    word.add_flag("--quick", options.quick, "without the slow cases; else all of them (--full)");
    word.add_flag("!--full", options.quick, "all cases; the default");
    word.add_option("--output", options.output, "folder of the pages")->capture_default_str();
    word.add_option("--catalogue", options.catalogue, "folder of other cases")
        ->check(CLI::ExistingDirectory);
}

/// Mistakes in values (units, tolerances) are left to services/import, so that the dashboard has
/// the same messages. allow_extra_args(false): else --map would take the words after it.
void add_import(Program& program) {
    const auto& [word, options] = program.add<ImportOptions>(
        "import", "a section drawn as DXF or CSV becomes a scene",
        "dam.dxf --materials materials.json --map CORE=clay --unit m --output scene.json",
        offline(import_drawing));
    word.add_option("DRAWING", options.drawing, "DXF (text form), or CSV with region,x,y")
        ->required();
    word.add_option("--materials", options.materials, "JSON with a scene's materials")->required();
    word.add_option("--output", options.output, "the scene (JSON)")->required();
    word.add_option("--draw", options.picture, "the section (SVG), with its faults in red");
    word.add_option("--map", options.map,
                    "LAYER=material, or LAYER=phreatic, terrain, ground, none; repeatable")
        ->allow_extra_args(false);
    word.add_option("--layers", options.layers,
                    "REGION=5,10,15 cuts it at these depths below the phreatic line [m]; "
                    "repeatable")
        ->allow_extra_args(false);
    word.add_option("--phreatic", options.phreatic, "phreatic line (CSV with x,y)");
    word.add_option("--terrain", options.terrain, "terrain of the runout (CSV with x,y)");
    word.add_option("--ground", options.ground, "ground to compare with (CSV with x,y)");
    word.add_option("--tolerance", options.tolerance, "gaps and overlaps up to this are healed [m]")
        ->capture_default_str();
    word.add_option("--unit", options.unit,
                    "of the drawing: m, mm, cm, ft, ...; DXF may say it itself");
    word.add_option("--flatten", options.flatten,
                    "arcs become chords that are off by at most this [m]");
    word.add_option("--name", options.name, "of the scene; else the drawing's");
    word.add_option(
            "--liquefied", options.liquefied,
            "REGION=0.08,SOURCE: liquefied at rest below the phreatic line, with this share "
            "of sigma'_v0 as residual strength (or 4kPa) and its source; with the peak: "
            "REGION=0.08,0.27,SOURCE; repeatable")
        ->allow_extra_args(false);
    word.add_flag("--with-fem", options.with_fem,
                  "shaken by a synthetic earthquake (PM4Sand, FEM, transfer, runout)");
    word.add_option("--pga", options.pga, help_of_dam("pga"));
    word.add_option("--shaking", options.shaking, help_of_dam("shaking"));
    word.add_flag("--force", options.force,
                  "with --liquefied or --with-fem: write over the files beside the scene");
    word.add_flag("--yes", options.confirmed, "sizes that look like a slip of the unit are meant");
}

}  // namespace

void add_words_of_documents(Program& program) {
    const auto planned = program.add<std::filesystem::path>(
        "plan", "what a scene or a study needs of each phase, what it leaves out, and why",
        "scene.json", plan);
    planned.word.add_option("SCENE|STUDY", planned.options, "scene or study file (JSON)")
        ->required();
    const auto made =
        program.add<NewOptions>("new", "a scene and its study from a template: --list has them",
                                "upstream_dam --height 30 --output my_dam", offline(make_new));
    take_templates(made.word, made.options);
    add_draw(program);
    add_motion(program);
    add_verify(program);
    add_import(program);
    add_mirror(program);
}

}  // namespace breach::cli
