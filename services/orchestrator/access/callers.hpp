// Identifies the caller of a request by its secret among the known tokens. The HTTP server asks
// before each request's handler, from many threads at once.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "services/orchestrator/access/tokens.hpp"

namespace breach::orchestrator {

struct Caller {
    std::string name;  ///< the token's name; empty: the service needs no token
    Right right = Right::none;
};

class Callers {
  public:
    /// secret: the admin's (--token-file); empty: none. file: named tokens; empty: none. Without
    /// both, anyone who can connect may do everything. Throws like read_tokens.
    Callers(const std::string& secret, std::filesystem::path file);

    bool needs_token() const { return !single_.empty() || !file_.empty(); }
    /// Nothing: no token has this secret. Takes equally long for every wrong secret. Changes of the
    /// file take effect within a second; if it becomes unusable, the last tokens stay valid and the
    /// log reports it.
    std::optional<Caller> caller(const std::string& secret) const;

  private:
    using Clock = std::chrono::steady_clock;
    std::shared_ptr<const std::vector<Token>> tokens() const;

    std::vector<Token> single_;
    std::filesystem::path file_;
    mutable std::mutex mutex_;
    mutable std::shared_ptr<const std::vector<Token>> of_file_;
    mutable std::string trouble_;  ///< error of the last read of the file
    mutable Clock::time_point looked_;
};

}  // namespace breach::orchestrator
