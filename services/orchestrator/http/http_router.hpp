// Routes by method and path template ("/v1/runs/{id}"), and problems (RFC 9457) as exceptions of
// the handlers. The router knows nothing of tokens: the server has asked needed() before.
#pragma once

#include <httplib.h>
#undef _res  // of <resolv.h>: Eigen has parameters of that name

#include <array>
#include <atomic>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/fault/fault.hpp"
#include "services/orchestrator/access/callers.hpp"

namespace breach::orchestrator {

/// The content of an answer other than 2xx; handlers throw it, the router writes it.
struct Problem {
    int status;
    std::string type;  ///< stable, below /problems/
    std::string title;
    std::string detail;
    std::vector<fault::Fault> faults = {};
};

Problem not_found(const std::string& what);
Problem bad_request(const std::string& detail);
Problem disk_is_full(const std::string& title);

void refuse(httplib::Response& response, const Problem& problem);
void reply(httplib::Response& response, const nlohmann::json& body, int status = 200);
void reply_with_text(httplib::Response& response, std::string body, int status = 200);

/// One request, as its handler gets it.
struct Call {
    const httplib::Request& request;
    httplib::Response& response;
    const Caller& caller;            ///< requester: its token's name is stored with every event
    std::vector<std::string> parts;  ///< values of the template's {…}, decoded
    /// Reads the body, once, where it is not kept in memory (HttpServer::answer).
    const httplib::ContentReader* body = nullptr;

    /// Unknown query parameters are 400, so that a misspelt filter is not silently ignored.
    void allow_parameters(const std::set<std::string>& names) const;
    std::optional<std::string> parameter(const std::string& name) const;
    std::int64_t whole_number(const std::string& name, std::int64_t otherwise, std::int64_t least,
                              std::int64_t most) const;
    std::optional<double> number(const std::string& name) const;
    /// The body; 415 when it is not declared as JSON (any page could send a web form).
    const std::string& json_body() const;
};

using Handler = std::function<void(Call&)>;

class Router {
  public:
    /// right: needed below /v1/; other paths are the dashboard and machine endpoints, open to all.
    void get(const std::string& path, Handler handler, Right right = Right::read);
    void post(const std::string& path, Handler handler, Right right = Right::submit);
    void remove(const std::string& path, Handler handler, Right right = Right::admin);
    /// The right that this method and path need; for a path that does not exist, that of reading.
    Right needed(const std::string& method, const std::string& path) const;
    /// Finds and runs the handler; every outcome becomes an answer, nothing is thrown.
    void answer(const httplib::Request& request, httplib::Response& response, const Caller& caller,
                const httplib::ContentReader* body = nullptr) const;
    /// Number of answers by class of status: [1] is 1xx, ... [5] is 5xx.
    std::array<std::uint64_t, 6> answers() const;

  private:
    struct Route {
        std::string method;
        std::vector<std::string> segments;
        Handler handler;
        Right right;
    };
    void add(const char* method, const std::string& path, Handler handler, Right right);
    void run(Call& call) const;
    void answer_uncounted(Call& call) const;
    std::vector<Route> routes_;
    mutable std::array<std::atomic<std::uint64_t>, 6> answers_{};
};

}  // namespace breach::orchestrator
