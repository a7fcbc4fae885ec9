// The file of tokens keeps SHA-256 of secrets. A plain hash is enough, as secrets are 256 random
// bits and cannot be guessed; a slow one would delay every request.
#include "services/orchestrator/access/tokens.hpp"

#include <openssl/rand.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/exchange/provenance.hpp"
#include "core/exchange/publish.hpp"
#include "core/fault/fault.hpp"

namespace breach::orchestrator {

using fault::BadInput;
using nlohmann::json;

namespace {

constexpr const char* format = "breachline-tokens/1";
constexpr std::array<std::string_view, 4> rights{"none", "read", "submit", "admin"};

bool is_name(const std::string& text) {
    constexpr std::size_t longest = 64;
    return !text.empty() && text.size() <= longest &&
           std::ranges::all_of(text, [](unsigned char c) {
               return std::isalnum(c) != 0 || c == '.' || c == '_' || c == '-' || c == '@';
           });
}

/// Hashes reveal no secret, but anyone who can write here becomes admin, and names are private.
void need_private(const std::filesystem::path& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0)
        throw fault::IoError(file.string() + ": " + std::strerror(errno) +
                             "; make it with: breachline token new NAME --rights submit --file " +
                             file.string());
    constexpr mode_t of_others = S_IRWXO | S_IWGRP;
    if ((status.st_mode & of_others) != 0)
        throw fault::IoError(file.string() +
                             ": others on this machine may read or change it; chmod 600 " +
                             file.string());
}

json as_json(const std::vector<Token>& tokens) {
    json list = json::array();
    for (const Token& each : tokens)
        list.push_back(
            {{"name", each.name}, {"rights", name_of(each.right)}, {"sha256", each.sha256}});
    return {{"format", format}, {"tokens", std::move(list)}};
}

std::string text_at(const json& entry, const char* key) {
    const auto found = entry.find(key);
    return found != entry.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// "none" is no entry of a file: it is the right of a caller without a token.
Token token_from(const json& entry, const std::string& pointer, const std::string& file) {
    const auto refuse = [&](const char* key, const char* cause) {
        throw BadInput(
            file, {{pointer + key, cause,
                    "make entries with: breachline token new NAME --rights read|submit|admin"}});
    };
    if (!entry.is_object()) refuse("", "is no entry");
    Token token{text_at(entry, "name"), Right::none, text_at(entry, "sha256")};
    if (!is_name(token.name)) refuse("/name", "must have 1 to 64 letters, digits or . _ - @");
    if (token.name == single_token_name)
        refuse("/name", "\"admin\" is the name of the token in --token-file");
    if (!exchange::is_sha256(token.sha256)) refuse("/sha256", "must be 64 hex digits");
    const auto right = std::ranges::find(rights, text_at(entry, "rights"));
    if (right == rights.end() || right == rights.begin())
        refuse("/rights", "must be read, submit or admin");
    token.right = static_cast<Right>(right - rights.begin());
    return token;
}

/// Private from the first byte on; an existing file keeps its owner and mode.
void save(const std::vector<Token>& tokens, const std::filesystem::path& file) {
    struct stat before {};
    const bool existed = ::stat(file.c_str(), &before) == 0;
    exchange::publish(file, [&](const std::filesystem::path& temporary) {
        { const std::ofstream empty(temporary); }
        if (::chmod(temporary.c_str(), existed ? before.st_mode & 07777 : 0600) != 0)
            throw fault::IoError(file.string() + ": " + std::strerror(errno));
        // Run by root (sudo), the new file would else be root's and the service could not read it.
        if (existed && ::chown(temporary.c_str(), before.st_uid, before.st_gid) != 0)
            throw fault::IoError(file.string() + ": cannot stay its owner's (" +
                                 std::strerror(errno) + "); run this as its owner");
        std::ofstream(temporary) << as_json(tokens).dump(1) << "\n";
    });
}

}  // namespace

std::string_view name_of(Right right) { return rights.at(static_cast<std::size_t>(right)); }

Right right_named(const std::string& name) {
    const auto found = std::ranges::find(rights, name);
    if (found == rights.end() || found == rights.begin())
        throw BadInput("command line", {{"--rights", "\"" + name + "\" is no right",
                                         "give read, submit or admin"}});
    return static_cast<Right>(found - rights.begin());
}

std::vector<Token> read_tokens(const std::filesystem::path& file) {
    // Before reading: a file that anyone could have changed gives no rights.
    need_private(file);
    std::ifstream stream(file);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream) throw fault::IoError(file.string() + ": cannot be read");
    const json document = json::parse(text.str(), nullptr, false);
    if (!document.is_object() || text_at(document, "format") != format ||
        !document.contains("tokens") || !document["tokens"].is_array())
        throw BadInput(
            file.string(),
            {{"", "is no file of tokens",
              R"(it must be {"format": "breachline-tokens/1", "tokens": [...]}; make it with: breachline token new)"}});
    std::vector<Token> tokens;
    for (const json& each : document["tokens"]) {
        const std::string pointer = "/tokens/" + std::to_string(tokens.size());
        tokens.push_back(token_from(each, pointer, file.string()));
        if (std::ranges::count(tokens, tokens.back().name, &Token::name) > 1)
            throw BadInput(file.string(),
                           {{pointer + "/name", "is there twice: " + tokens.back().name,
                             "take one away: breachline token rm NAME"}});
    }
    return tokens;
}

/// The secret leaves here and is kept nowhere: who loses it gets a new token.
std::string add_token(const std::filesystem::path& file, const std::string& name, Right right) {
    std::vector<Token> tokens;
    if (std::filesystem::exists(file)) tokens = read_tokens(file);
    if (!is_name(name) || name == single_token_name)
        throw BadInput("command line",
                       {{"NAME", "\"" + name + "\" cannot be a token's name",
                         "give 1 to 64 letters, digits or . _ - @, other than \"admin\""}});
    if (std::ranges::find(tokens, name, &Token::name) != tokens.end())
        throw BadInput(file.string(),
                       {{"NAME", name + " has a token already",
                         "take another name, or first: breachline token rm " + name}});
    // From the system's source of random numbers; a secret of 256 bits cannot be guessed.
    std::array<unsigned char, 32> random{};
    if (RAND_bytes(random.data(), static_cast<int>(random.size())) != 1)
        throw fault::IoError("the machine gives no random numbers");
    std::string secret;
    for (const unsigned char each : random) {
        constexpr std::string_view digits = "0123456789abcdef";
        secret += digits[each >> 4];
        secret += digits[each & 15];
    }
    tokens.push_back({name, right, exchange::sha256_of_text(secret)});
    save(tokens, file);
    return secret;
}

void remove_token(const std::filesystem::path& file, const std::string& name) {
    std::vector<Token> tokens = read_tokens(file);
    if (std::erase_if(tokens, [&](const Token& each) { return each.name == name; }) == 0)
        throw BadInput(file.string(), {{"NAME", "there is no token of " + name,
                                        "breachline token list says which there are"}});
    save(tokens, file);
}

}  // namespace breach::orchestrator
