// Finds the route for a method and path and turns what a handler throws into a problem document
// (RFC 9457). Routes are added once at the start and only read afterwards, so no lock is needed.
#include "services/orchestrator/http/http_router.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

#include "services/orchestrator/http/answers.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

std::string text_of(const json& body) {
    return body.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::vector<std::string> segments_of(const std::string& path) {
    std::vector<std::string> segments;
    std::istringstream stream(path);
    std::string segment;
    // Empty segments are dropped: /v1//runs/ is /v1/runs.
    while (std::getline(stream, segment, '/')) {
        if (!segment.empty()) segments.push_back(segment);
    }
    return segments;
}

/// HEAD is GET without the body.
const std::string& read_method(const std::string& method) {
    static const std::string get = "GET";
    return method == "HEAD" ? get : method;
}

/// A last segment "{rest...}" matches the rest of the path.
bool matches(const std::vector<std::string>& pattern, const std::vector<std::string>& path,
             std::vector<std::string>& parts) {
    parts.clear();
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        if (pattern[i].ends_with("...}")) {
            std::string rest;
            for (std::size_t k = i; k < path.size(); ++k) rest += (k > i ? "/" : "") + path[k];
            parts.push_back(rest);
            return !rest.empty();
        }
        if (i >= path.size()) return false;
        if (pattern[i].starts_with('{')) {
            parts.push_back(path[i]);
        } else if (pattern[i] != path[i]) {
            return false;
        }
    }
    return pattern.size() == path.size();
}

}  // namespace

Problem not_found(const std::string& what) {
    return {404, "/problems/not-found", "Not found", "there is no " + what};
}

Problem bad_request(const std::string& detail) {
    return {400, "/problems/bad-request", "Bad request", detail};
}

Problem disk_is_full(const std::string& title) {
    return {503, "/problems/storage", title,
            "the disk of the data folder is full, so nothing is stored: free some space, then "
            "repeat the request"};
}

void refuse(httplib::Response& response, const Problem& problem) {
    json body{{"type", problem.type},
              {"title", problem.title},
              {"status", problem.status},
              {"detail", problem.detail}};
    if (!problem.faults.empty()) body["faults"] = as_json(problem.faults);
    response.status = problem.status;
    response.set_content(text_of(body), "application/problem+json");
}

void reply(httplib::Response& response, const json& body, int status) {
    reply_with_text(response, text_of(body), status);
}

void reply_with_text(httplib::Response& response, std::string body, int status) {
    response.status = status;
    // Answers are of this moment; only contents with a hash may be kept (send_content).
    response.set_header("Cache-Control", "no-store");
    response.set_header("Content-Type", "application/json");
    response.body = std::move(body);
}

void Call::allow_parameters(const std::set<std::string>& names) const {
    // httplib would read a form as parameters, and curl declares any body a form by default.
    if (request.get_header_value("Content-Type").starts_with("application/x-www-form-urlencoded") &&
        !request.body.empty())
        json_body();
    for (const auto& [name, value] : request.params) {
        if (names.contains(name)) continue;
        std::string known;
        for (const std::string& each : names) known += (known.empty() ? "" : ", ") + each;
        throw bad_request("unknown query parameter \"" + name +
                          "\"; known here: " + (known.empty() ? "none" : known));
    }
}

std::optional<std::string> Call::parameter(const std::string& name) const {
    if (!request.has_param(name)) return std::nullopt;
    return request.get_param_value(name);
}

/// Whether the whole text is a number.
template <class Number>
static bool is_read(const std::string& text, Number& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
}

std::int64_t Call::whole_number(const std::string& name, std::int64_t otherwise, std::int64_t least,
                                std::int64_t most) const {
    const auto text = parameter(name);
    if (!text || text->empty()) return otherwise;
    std::int64_t value = 0;
    if (!is_read(*text, value) || value < least || value > most) {
        throw bad_request(name + " must be a whole number from " + std::to_string(least) + " to " +
                          std::to_string(most));
    }
    return value;
}

std::optional<double> Call::number(const std::string& name) const {
    const auto text = parameter(name);
    if (!text || text->empty()) return std::nullopt;
    double value = 0.0;
    if (!is_read(*text, value) || !std::isfinite(value))
        throw bad_request(name + " must be a number");
    return value;
}

/// A page elsewhere can make a browser send a form, but not this content type without being asked.
const std::string& Call::json_body() const {
    if (!request.get_header_value("Content-Type").starts_with("application/json")) {
        throw Problem{415, "/problems/unsupported-media-type", "Unsupported media type",
                      "send the body with the header Content-Type: application/json"};
    }
    return request.body;
}

/// Open paths are the dashboard, health, metrics and the description: a page must load before
/// anyone can give it a token.
void Router::add(const char* method, const std::string& path, Handler handler, Right right) {
    if (!path.starts_with("/v1/")) right = Right::none;
    routes_.push_back({method, segments_of(path), std::move(handler), right});
}

void Router::get(const std::string& path, Handler handler, Right right) {
    add("GET", path, std::move(handler), right);
}

void Router::post(const std::string& path, Handler handler, Right right) {
    add("POST", path, std::move(handler), right);
}

void Router::remove(const std::string& path, Handler handler, Right right) {
    add("DELETE", path, std::move(handler), right);
}

/// Asked before the handler runs. A path that does not exist needs the right to read: a stranger
/// learns nothing about paths.
Right Router::needed(const std::string& method, const std::string& path) const {
    const std::vector<std::string> segments = segments_of(path);
    std::vector<std::string> parts;
    for (const Route& route : routes_)
        if (route.method == read_method(method) && matches(route.segments, segments, parts))
            return route.right;
    return path.starts_with("/v1/") ? Right::read : Right::none;
}

std::array<std::uint64_t, 6> Router::answers() const {
    std::array<std::uint64_t, 6> counts{};
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = answers_[i];
    return counts;
}

void Router::answer(const httplib::Request& request, httplib::Response& response,
                    const Caller& caller, const httplib::ContentReader* body) const {
    Call call{request, response, caller, {}, body};
    answer_uncounted(call);
    const int status = response.status < 0 ? 200 : response.status;  // httplib: -1 is not set yet
    ++answers_[static_cast<std::size_t>(std::clamp(status / 100, 0, 5))];
}

/// The one place where exceptions become answers. 503 with Retry-After where a client may simply
/// ask again.
void Router::answer_uncounted(Call& call) const {
    const httplib::Request& request = call.request;
    httplib::Response& response = call.response;
    try {
        run(call);
    } catch (const Problem& problem) {
        refuse(response, problem);
    } catch (const fault::BadInput& error) {
        refuse(response, {422, "/problems/bad-input", "Bad input",
                          error.file() + ": " + error.count(), error.faults()});
    } catch (const DiskFull& error) {
        spdlog::error("{} {}: {}", request.method, request.path, error.what());
        response.set_header("Retry-After", "5");
        refuse(response, disk_is_full("The disk is full"));
    } catch (const StoreError& error) {
        spdlog::error("{} {}: {}", request.method, request.path, error.what());
        response.set_header("Retry-After", "5");
        refuse(response,
               {503, "/problems/storage", "The database refused", "nothing was stored; try again"});
    } catch (const RemovedMeanwhile&) {
        // Not 404: the removed run may not be the requested one.
        response.set_header("Retry-After", "1");
        refuse(response, {503, "/problems/removed-meanwhile", "Removed meanwhile",
                          "a run was removed while this was read; ask again"});
    } catch (const std::exception& error) {
        spdlog::error("{} {}: {}", request.method, request.path, error.what());
        refuse(response,
               {500, "/problems/internal", "Internal fault", "the service's log says more"});
    }
}

/// In the order in which routes were added; no two of them match the same path and method.
void Router::run(Call& call) const {
    const httplib::Request& request = call.request;
    const std::string& method = read_method(request.method);
    const std::vector<std::string> path = segments_of(request.path);
    std::string allowed;
    for (const Route& route : routes_) {
        if (!matches(route.segments, path, call.parts)) continue;
        if (route.method == method) {
            route.handler(call);
            return;
        }
        allowed += (allowed.empty() ? "" : ", ") + route.method;
    }
    if (allowed.empty()) throw not_found("such path here");
    call.response.set_header("Allow", allowed);
    throw Problem{405, "/problems/method-not-allowed", "Method not allowed",
                  request.method + " is not possible here; possible: " + allowed};
}

}  // namespace breach::orchestrator
