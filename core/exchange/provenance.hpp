// Provenance of a file: stored in every output to trace a number to its inputs. A session collects
// it (Session::provenance); a resumed run compares scene and inputs with its checkpoint's.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breach::exchange {

struct InputDigest {
    std::string path;
    std::string sha256;
};

/// Time that all processes of a run spent until the file was written [s].
struct Spent {
    double wall = 0.0;
    double cpu = 0.0;
};

struct Provenance {
    std::string phase;                   ///< "fem_solver", ...
    std::string version;                 ///< Breachline version
    std::string scene;                   ///< completed scene, JSON text
    std::vector<std::string> overrides;  ///< "/pointer=value" as given
    std::vector<InputDigest> inputs;
    int threads = 1;
    Spent spent = {};
};

/// SHA-256 of a file as 64 hexadecimal digits. Throws IoError.
std::string sha256_of_file(const std::filesystem::path& path);
std::string sha256_of_text(const std::string& text);
/// Whether the text is 64 hexadecimal digits in lower case.
bool is_sha256(const std::string& text);

}  // namespace breach::exchange
