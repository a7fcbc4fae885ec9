// Who may ask for what: named tokens with rights, and the file that keeps them. The secrets themselves are
// not in it, only their SHA-256: they are 32 random bytes, which nobody can try out.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace breach::orchestrator {

/// Each has those before it. read: everything that GET answers. submit: also what computes or changes a
/// run. admin: also what removes, or keeps from being removed.
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

/// The name that events give to whoever has the token of --token-file.
inline constexpr const char* single_token_name = "admin";

/// Throws IoError (not there, or others on this machine may read or change it) and BadInput.
std::vector<Token> read_tokens(const std::filesystem::path& file);
/// Makes an entry, and the file where there is none (mode 0600); returns the secret, which is kept nowhere.
/// Throws as above; BadInput also when the name is taken.
std::string add_token(const std::filesystem::path& file, const std::string& name, Right right);
/// Throws as above; BadInput also when there is no such name.
void remove_token(const std::filesystem::path& file, const std::string& name);

}  // namespace breach::orchestrator
