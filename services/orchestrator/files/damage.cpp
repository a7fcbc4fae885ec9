// The store knows what each output was; this compares. The cache looks at contents, the audit may
// look at sizes only, which is much faster.
#include "services/orchestrator/files/damage.hpp"

#include "core/exchange/provenance.hpp"

namespace breach::orchestrator {

std::optional<std::string> damage_of(const std::filesystem::path& file, std::int64_t bytes,
                                     const std::string& sha256, Look look) {
    std::error_code error;
    const auto size = std::filesystem::file_size(file, error);
    if (error) return "is missing";
    if (static_cast<std::int64_t>(size) != bytes)
        return "has " + std::to_string(size) + " bytes, not " + std::to_string(bytes);
    if (look == Look::at_contents && exchange::sha256_of_file(file) != sha256)
        return "has other contents than were stored";
    return std::nullopt;
}

}  // namespace breach::orchestrator
