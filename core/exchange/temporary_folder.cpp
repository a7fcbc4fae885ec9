// Made by mkdtemp: a name that no other process has, readable by this user only.
#include "core/exchange/temporary_folder.hpp"

#include <cstdlib>

#include "core/fault/fault.hpp"

namespace breach::exchange {

TemporaryFolder::TemporaryFolder(const std::string& prefix, const std::filesystem::path& in) {
    std::string name = (in / (prefix + "XXXXXX")).string();
    if (mkdtemp(name.data()) == nullptr) throw fault::IoError(name + ": cannot be made");
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    // A destructor may not throw, and may run because of another exception.
    std::error_code ignored;  // what is left lies below the temporary folder
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace breach::exchange
