// Uploads motions and meshes that a study names by path to a server that does not have them.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/fault/fault.hpp"
#include "services/cli/console.hpp"
#include "services/cli/http/server.hpp"

namespace breach::cli {

/// Returns the file's name in scenes. Sends the file only when the server does not have it, and
/// again when the upload was incomplete.
std::string send_file(Server& server, const std::filesystem::path& file, const Console& console);

enum class Sending { where_needed, always };

/// The "warnings" of an answer, one line each.
void show_warnings(const nlohmann::json& answer, const Console& console);

/// Whether the fault may be due to a file that exists on this machine only.
bool is_about_a_file(const fault::Fault& fault);

/// Posts the study and shows the warnings of the answer. First sends the files named in its scene
/// or overrides if the server is another machine or reports that it does not find them.
nlohmann::json post_study(Server& server, const std::string& route, nlohmann::json study,
                          const Headers& headers, Sending sending, const Console& console);

/// The same for a scene alone.
nlohmann::json post_scene(Server& server, const std::string& route, const nlohmann::json& scene,
                          Sending sending, const Console& console);

}  // namespace breach::cli
