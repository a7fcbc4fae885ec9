// Named tokens with rights, and their file. It contains only the SHA-256 of the secrets, which are
// 32 random bytes and cannot be guessed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace breach::orchestrator {

/// Each right includes those before it. read: all GET requests. submit: also requests that compute
/// or change a run. admin: also removal. http_router.hpp gives each method's requests their right.
enum class Right { none, read, submit, admin };
std::string_view name_of(Right right);
/// Throws BadInput.
Right right_named(const std::string& name);

struct Token {
    std::string name;
    Right right = Right::none;
    std::string sha256;  ///< of the secret, 64 hex digits

    bool operator==(const Token&) const = default;
};

inline constexpr const char* single_token_name = "admin";

/// Throws IoError (missing, or others on this machine may read or change it) and BadInput.
std::vector<Token> read_tokens(const std::filesystem::path& file);
/// Adds an entry, and creates the file if there is none (mode 0600). Returns the secret, which is
/// not stored anywhere. Throws as above; BadInput also when the name exists.
std::string add_token(const std::filesystem::path& file, const std::string& name, Right right);
/// Throws as above; BadInput also when there is no such name.
void remove_token(const std::filesystem::path& file, const std::string& name);

}  // namespace breach::orchestrator
