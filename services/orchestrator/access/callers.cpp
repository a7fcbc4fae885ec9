// Who is calling, for every request, on its thread. The file of tokens is read again at most once
// a second, so that a removed token loses its rights without a restart. A file that cannot be
// read leaves the last tokens in force: an editor's slip must not lock everyone out.
#include "services/orchestrator/access/callers.hpp"

#include <openssl/crypto.h>
#include <spdlog/spdlog.h>

#include "core/exchange/provenance.hpp"

namespace breach::orchestrator {

Callers::Callers(const std::string& secret, std::filesystem::path file)
    : file_(std::move(file)), looked_(Clock::now()) {
    if (!secret.empty())
        // Hashed like the others, so that one comparison serves both and no plain secret is kept.
        single_.push_back({single_token_name, Right::admin, exchange::sha256_of_text(secret)});
    if (!file_.empty()) of_file_ = std::make_shared<const std::vector<Token>>(read_tokens(file_));
}

std::shared_ptr<const std::vector<Token>> Callers::tokens() const {
    // Held while the file is read: requests then wait for one reading instead of starting their
    // own.
    const std::lock_guard lock(mutex_);
    const auto now = Clock::now();
    if (file_.empty() || now - looked_ < std::chrono::seconds(1)) return of_file_;
    looked_ = now;
    try {
        std::vector<Token> found = read_tokens(file_);
        trouble_.clear();
        // The caller keeps its pointer through a change; the old list lives until it is done.
        if (found == *of_file_) return of_file_;
        of_file_ = std::make_shared<const std::vector<Token>>(std::move(found));
        spdlog::info("{}: {} tokens", file_.string(), of_file_->size());
    } catch (const std::exception& error) {
        if (trouble_ != error.what())
            spdlog::error("{}; the tokens before this change stay in force", error.what());
        trouble_ = error.what();
    }
    return of_file_;
}

std::optional<Caller> Callers::caller(const std::string& secret) const {
    const std::string hash = exchange::sha256_of_text(secret);
    std::optional<Caller> found;
    const auto compare = [&](const std::vector<Token>& tokens) {
        for (const Token& each : tokens)  // always all of them: constant time
            if (CRYPTO_memcmp(hash.data(), each.sha256.data(), hash.size()) == 0)
                found = Caller{each.name, each.right};
    };
    compare(single_);
    // One list, taken once: it cannot change between two comparisons.
    if (const auto of_file = tokens()) compare(*of_file);
    return found;
}

}  // namespace breach::orchestrator
