// `breach import`: reads the files, calls services/import, and shows the drawing with its faults.
// The import itself needs no server, and reads no file: the dashboard uses the same code with
// bytes.
#include "services/cli/import.hpp"

#include <unistd.h>

#include <fstream>
#include <iostream>
#include <iterator>

#include "core/exchange/publish.hpp"
#include "core/scene/schema.hpp"
#include "services/cli/new_scene.hpp"
#include "services/cli/table.hpp"
#include "services/drawing/section_drawing.hpp"
#include "services/import/import.hpp"

namespace breach::cli {

using fault::ExitCode;
using nlohmann::json;

namespace {

/// Drawings are read whole into memory, once as bytes and once as outlines.
constexpr std::uintmax_t most_bytes = 256 << 20;
/// A coarse drawing may have hundreds; --json prints all.
constexpr std::size_t most_lines = 12;  // of corrections

std::string bytes_of(const std::filesystem::path& file) {
    std::error_code none;
    if (!std::filesystem::is_regular_file(file, none))
        throw fault::IoError(file.string() + ": is no file that can be read");
    if (std::filesystem::file_size(file, none) > most_bytes)
        throw fault::BadInput(file.string(), {{"", "is larger than 256 MiB",
                                               "export the layers of the section alone"}});
    std::ifstream stream(file, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(stream)), {});
    if (!stream) throw fault::IoError(file.string() + ": cannot be read");
    return bytes;
}

/// Only the name goes along, not the path: it appears in messages and in the scene's name.
std::optional<importing::Sent> sent(const std::filesystem::path& file) {
    if (file.empty()) return std::nullopt;
    return importing::Sent{file.filename().string(), bytes_of(file)};
}

/// Whether to_confirm are the only faults, and the user at a terminal confirms them. Asks only at
/// a terminal: a script must give --yes or fail.
bool is_confirmed(const importing::Imported& imported, const Console& console) {
    const auto& to_confirm = imported.to_confirm;
    if (to_confirm.empty() || to_confirm.size() < imported.faults.size()) return false;
    if (isatty(STDIN_FILENO) != 1 || isatty(STDERR_FILENO) != 1) return false;
    for (const fault::Fault& each : to_confirm) console.notes << each.cause << "\n";
    console.notes << "Is that right? [y/N] " << std::flush;
    std::string answer;
    std::getline(std::cin, answer);
    // Anything else means no, also the end of the input.
    return answer == "y" || answer == "Y" || answer == "yes";
}

/// Study, and a motion if there is one, beside the scene, with the file names of `breach new`.
/// The study names the scene by its file name alone, so that the folder can be moved.
Files beside(const std::filesystem::path& scene, importing::Imported& imported) {
    if (imported.study.is_null()) return {};
    imported.study["scene"] = scene.filename().string();
    Files files{{scene.parent_path() / "study.json", imported.study.dump(1) + "\n"}};
    if (!imported.motion.empty())
        files[scene.parent_path() / earthquake::motion_file] = imported.motion;
    if (files.contains(scene))
        throw fault::BadInput("breach import",
                              {{"--output", "is the name of the " + scene.stem().string(),
                                "give another one, such as scene.json"}});
    return files;
}

}  // namespace

/// Nothing is written while there are faults, except the picture that shows them.
ExitCode import_drawing(const ImportOptions& options, const Console& console) {
    importing::Request asked{
        .drawing = *sent(options.drawing),
        .materials = scene::parse_json(bytes_of(options.materials), options.materials.string()),
        .map = options.map,
        .layers = options.layers,
        .phreatic = sent(options.phreatic),
        .terrain = sent(options.terrain),
        .ground = sent(options.ground),
        .unit = options.unit,
        .tolerance = options.tolerance,
        .flatten = options.flatten,
        .name = options.name,
        .confirmed = options.confirmed,
        .liquefied = options.liquefied};
    if (options.with_fem) {
        auto& motion = asked.motion.emplace();
        motion.pga = options.pga.value_or(motion.pga);
        motion.shaking = options.shaking.value_or(motion.shaking);
    }
    importing::Imported imported = importing::import_section(asked);
    // The whole import again: with the confirmation it goes on to checks that it had left out.
    if (is_confirmed(imported, console)) {
        asked.confirmed = true;
        imported = importing::import_section(asked);
    }
    const json shown =
        imported.faults.empty()
            ? imported.scene
            : json{{"title", "What is wrong with " + options.drawing.filename().string()}};
    const drawing::Draft draft{{shown, {}, ""}, std::move(imported.sketch), imported.faults};
    if (!options.picture.empty() && drawing::can_be_drawn(draft))
        write_files({{options.picture, drawing::as_svg(draft, {})}});
    if (!imported.faults.empty())
        throw fault::BadInput(options.drawing.string(), std::move(imported.faults));
    // The scene itself is not among the files that are protected: --output names it, and a drawing
    // is imported again and again. study.json and motion.csv the user did not name.
    Files files = beside(options.output, imported);
    if (!options.force) refuse_to_overwrite(files, "breach import");
    files[options.output] = imported.scene.dump(1) + "\n";
    write_files(files);
    if (shown_as_json(imported.report, console)) return ExitCode::done;
    for (const std::string& each : importing::lines_of(imported.report, most_lines))
        console.notes << each << "\n";
    for (const auto& [path, text] : files) console.out << path.string() << "\n";
    return ExitCode::done;
}

}  // namespace breach::cli
