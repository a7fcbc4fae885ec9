#include "services/report/chart/png.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <string>

#include "core/exchange/publish.hpp"
#include "core/fault/fault.hpp"

namespace breach::report {

Converter png_converter() {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        if (access((folder + "/rsvg-convert").c_str(), X_OK) == 0) return Converter::there;
    }
    return Converter::missing;
}

void write_png(const std::filesystem::path& svg, const std::filesystem::path& png) {
    exchange::publish(png, [&](const std::filesystem::path& temporary) {
        std::string words[] = {"rsvg-convert",
                               "--zoom=2",
                               "--unlimited",
                               "--format=png",
                               "--output=" + temporary.string(),
                               svg.string()};
        char* arguments[std::size(words) + 1] = {};
        for (std::size_t i = 0; i < std::size(words); ++i) arguments[i] = words[i].data();
        pid_t child = 0;
        int status = 0;
        const int error = posix_spawnp(&child, arguments[0], nullptr, nullptr, arguments, environ);
        if (error == 0) waitpid(child, &status, 0);
        if (error != 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
            throw fault::IoError(png.string() + ": rsvg-convert could not draw " + svg.string());
        }
    });
}

}  // namespace breach::report
