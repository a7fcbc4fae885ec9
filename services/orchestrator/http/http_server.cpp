// Between the sockets (httplib) and the router: limits, tokens and bodies. Each request runs on a
// thread of the pool; the handlers below are the only ones. What is refused here never reaches a
// route. stop() lets running requests end; streams see `stopping_` and close.
#include "services/orchestrator/http/http_server.hpp"

#include <spdlog/spdlog.h>
#include <strings.h>
#include <sys/socket.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "core/words/loopback.hpp"
#include "services/orchestrator/access/callers.hpp"
#include "services/orchestrator/http/http_routes.hpp"

namespace breach::orchestrator {

namespace {

/// Held in memory by each request. Files may be larger: POST /v1/files streams them.
constexpr std::size_t largest_body = 16 << 20;
constexpr std::size_t most_headers = 64;
constexpr std::size_t added_by_httplib = 4;    // REMOTE_ADDR and the like
constexpr std::size_t most_connections = 256;  // each needs a thread, streams for long
constexpr std::size_t most_requests_per_connection = 1000;
constexpr auto longest_pause = std::chrono::seconds(10);  // between a client's reads or writes
constexpr int backlog = 512;

/// The secret after "Bearer " (any case, RFC 9110) in the header; empty: none.
std::string secret_of(const httplib::Request& request) {
    constexpr std::string_view scheme = "Bearer ";
    const std::string given = request.get_header_value("Authorization");
    if (strncasecmp(given.c_str(), scheme.data(), scheme.size()) != 0) return "";
    return given.substr(std::min(given.find_first_not_of(' ', scheme.size()), given.size()));
}

/// The request's length is ambiguous: bytes after it on the connection cannot be trusted.
/// Two readers of one connection (a proxy and this one) could disagree about where the request
/// ends, and one client's bytes become another's request.
bool has_doubtful_end(const httplib::Request& request) {
    const auto lengths = request.get_header_value_count("Content-Length");
    const auto encodings = request.get_header_value_count("Transfer-Encoding");
    return lengths > 1 || encodings > 1 || (lengths > 0 && encodings > 0);
}

/// Writes the answer and then fails on purpose, which makes httplib close the connection.
void close_after(httplib::Response& response) {
    const std::string body = std::move(response.body);
    response.body.clear();
    response.headers.erase("Content-Type");
    response.set_header("Connection", "close");
    response.set_content_provider(body.size(), "application/problem+json",
                                  [body](std::size_t, std::size_t, httplib::DataSink& sink) {
                                      sink.write(body.data(), body.size());
                                      return false;
                                  });
}

void refuse_and_close(httplib::Response& response, const Problem& problem) {
    refuse(response, problem);
    close_after(response);
}

Problem too_large() {
    return {413, "/problems/too-large", "Content too large",
            "the body may have " + std::to_string(largest_body) + " bytes"};
}

/// The body of one request, read at most once.
/// Announced and received length both count: a client may say less than it sends.
class Intake {
  public:
    Intake(const httplib::Request& request, const httplib::ContentReader* body) {
        if (body == nullptr) return;
        left_ = true;
        // httplib reads forms through another function.
        const bool form = request.is_multipart_form_data();
        announced_ = std::strtoull(request.get_header_value("Content-Length").c_str(), nullptr, 10);
        reader_ = httplib::ContentReader(
            [this, body, form](httplib::ContentReceiver receive) {
                asked_ = true;
                // No path here uses the parts of a form.
                const bool whole =
                    form ? (*body)([](const httplib::MultipartFormData&) { return true; },
                                   [](const char*, std::size_t) { return true; })
                         : (*body)(std::move(receive));
                left_ = !whole;
                return whole;
            },
            nullptr);
    }

    /// Throws 413, without the text. Reads and drops some of the excess, so that the sender gets
    /// the answer.
    void keep_in(std::string& text) {
        if (!left_) return;
        std::size_t bytes = 0;
        const bool whole = reader_([&](const char* data, std::size_t size) {
            bytes += size;
            if (std::max(bytes, announced_) <= largest_body) text.append(data, size);
            return bytes <= most_dropped;
        });
        if (bytes > largest_body) {
            text.clear();
            throw too_large();
        }
        if (!whole) throw bad_request("the body did not arrive whole");
    }

    const httplib::ContentReader* reader() const { return &reader_; }

    bool is_at_its_end() {
        std::size_t bytes = 0;
        if (left_ && !asked_)
            reader_([&](const char*, std::size_t size) { return (bytes += size) <= most_dropped; });
        return !left_;
    }

  private:
    static constexpr std::size_t most_dropped = 4 * largest_body;
    bool left_ = false;          ///< there may be unread bytes
    std::size_t announced_ = 0;  ///< Content-Length [bytes]
    bool asked_ = false;
    httplib::ContentReader reader_{nullptr, nullptr};
};

/// Says who can help: a user cannot make a token.
Problem missing_right(const Caller& caller, Right needed) {
    const std::string right(name_of(needed));
    return {403, "/problems/missing-right", "Missing right",
            "this takes the right \"" + right + "\"; the token \"" + caller.name + "\" has \"" +
                std::string(name_of(caller.right)) +
                "\". Whoever runs the service can make one: breachline token new NAME --rights " +
                right};
}

Problem problem_of(int status) {
    if (status == 413) return too_large();
    return {status, "/problems/bad-request", "Bad request", "the request cannot be understood"};
}

}  // namespace

/// Order of the members: the server is the last one, so that it is gone before what its handlers
/// use.
class HttpServer::Implementation {
  public:
    Implementation(Service& service, HttpSettings settings)
        : settings_(std::move(settings)), callers_(settings_.token, settings_.tokens) {
        add_all_routes(router_, service, stopping_);
        server_.set_default_headers({{"X-Content-Type-Options", "nosniff"}});
        set_connections();
        set_handlers();
        bind();
    }

    int port() const { return port_; }
    void serve() {
        server_.listen_after_bind();
        ended_ = true;
    }
    void stop() {
        stopping_ = true;
        // httplib ignores a stop before its loop begins, and would then never stop.
        constexpr auto moment = std::chrono::milliseconds(5);
        while (!ended_ && !server_.is_running()) std::this_thread::sleep_for(moment);
        server_.stop();
    }

  private:
    void set_connections() {
        // A thread per connection: streams hold theirs for as long as the page is open.
        server_.new_task_queue = [] { return new httplib::ThreadPool(most_connections); };
        server_.set_keep_alive_max_count(most_requests_per_connection);
        server_.set_read_timeout(longest_pause);
        server_.set_write_timeout(longest_pause);
        server_.set_tcp_nodelay(true);
        // httplib's default lets a second service share the port.
        server_.set_socket_options([this](socket_t socket) {
            const int on = 1;
            setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
            listening_ = socket;
        });
    }

    void set_handlers() {
        server_.set_pre_routing_handler(
            [this](const httplib::Request& request, httplib::Response& response) {
                // Only artifacts and files allow ranges; many ranges would multiply other answers.
                const bool parts = (request.path.starts_with("/v1/artifacts/") ||
                                    request.path.starts_with("/v1/files/")) &&
                                   request.ranges.size() == 1;
                if (!parts) const_cast<httplib::Request&>(request).ranges.clear();
                if (has_doubtful_end(request)) {
                    refuse_and_close(response, bad_request("the request's length is given twice"));
                    return httplib::Server::HandlerResponse::Handled;
                }
                // A request without Content-Length has no body; httplib would wait for one.
                const bool bodiless = request.method == "GET" || request.method == "HEAD" ||
                                      request.method == "OPTIONS";
                if (bodiless || request.has_header("Content-Length") ||
                    request.has_header("Transfer-Encoding"))
                    return httplib::Server::HandlerResponse::Unhandled;
                answer(request, response, nullptr);
                return httplib::Server::HandlerResponse::Handled;
            });
        const httplib::Server::Handler handler = [this](const httplib::Request& request,
                                                        httplib::Response& response) {
            answer(request, response, nullptr);
        };
        const httplib::Server::HandlerWithContentReader handler_with_body =
            [this](const httplib::Request& request, httplib::Response& response,
                   const httplib::ContentReader& body) { answer(request, response, &body); };
        server_.Get(".*", handler);
        server_.Options(".*", handler);
        server_.Post(".*", handler_with_body);
        server_.Put(".*", handler_with_body);
        server_.Patch(".*", handler_with_body);
        server_.Delete(".*", handler_with_body);
        // httplib's own refusals (a broken request line, a body that is too long) get a problem
        // document as well.
        server_.set_error_handler([](const httplib::Request&, httplib::Response& response) {
            if (response.body.empty() && !response.content_provider_)
                refuse(response, problem_of(response.status));
        });
        // Handlers throw nothing (Router::answer); this is for what fails around them.
        server_.set_exception_handler([](const httplib::Request&, httplib::Response& response,
                                         const std::exception_ptr&) {
            refuse(response,
                   {500, "/problems/internal", "Internal fault", "the service's log says more"});
        });
    }

    /// Keeps small bodies in memory only. An unread rest would be taken as the next request, so the
    /// connection is closed.
    void answer(const httplib::Request& request, httplib::Response& response,
                const httplib::ContentReader* body) const {
        Intake intake(request, body);
        try {
            const Caller caller = admitted(request, response);
            // The only body that may be larger than memory allows.
            const bool streamed = request.method == "POST" && request.path == "/v1/files";
            if (!streamed) intake.keep_in(const_cast<httplib::Request&>(request).body);
            router_.answer(request, response, caller, streamed ? intake.reader() : nullptr);
        } catch (const Problem& problem) {
            refuse(response, problem);
        }
        if (!intake.is_at_its_end()) close_after(response);
    }

    /// Identifies the caller. Throws the problem if the caller lacks the right.
    /// From the cheapest check to the dearest; the secret comes last.
    Caller admitted(const httplib::Request& request, httplib::Response& response) const {
        if (request.headers.size() > most_headers + added_by_httplib)
            throw Problem{431, "/problems/too-many-headers", "Too many headers",
                          "at most 64 are read"};
        if (request.get_header_value("Range").find(',') != std::string::npos)
            throw Problem{416, "/problems/range", "Range not satisfiable", "one range at a time"};
        const std::string host = request.get_header_value("Host");
        // A web page elsewhere could reach a service on loopback through a user's browser.
        if (!callers_.needs_token() && !words::is_loopback_authority(host))
            throw Problem{421, "/problems/misdirected", "Misdirected request",
                          "without a token the service answers only as localhost"};
        const std::string origin = request.get_header_value("Origin");
        if (!origin.empty() && origin != "http://" + host && origin != "https://" + host)
            throw Problem{403, "/problems/foreign-origin", "Forbidden",
                          "only the service's own pages may ask from a browser"};
        if (!callers_.needs_token()) return {"", Right::admin};
        const std::string secret = secret_of(request);
        const auto known = secret.empty() ? std::nullopt : callers_.caller(secret);
        const Right needed = router_.needed(request.method, request.path);
        // 403 for a known token, 401 for none or a wrong one.
        if (known && known->right < needed) throw missing_right(*known, needed);
        if (known || needed == Right::none) return known.value_or(Caller{});
        response.set_header("WWW-Authenticate", "Bearer");
        throw Problem{401, "/problems/unauthorized", "Unauthorized",
                      "send a token of this service: Authorization: Bearer ..."};
    }

    /// Refuses an open service that other machines could reach, before anything is served.
    void bind() {
        if (!callers_.needs_token() && !words::is_loopback(settings_.host)) {
            throw fault::BadInput(
                "command line",
                {{"--host",
                  settings_.host + " is no loopback address: other machines may reach it, and "
                                   "there is no token",
                  "stay on 127.0.0.1; for other machines give --tokens FILE (or --token-file FILE) "
                  "and put nginx with TLS in front (docs/how-to/reverse_proxy.md)"}});
        }
        if (!words::is_loopback(settings_.host))
            spdlog::warn(
                "tokens and results travel unencrypted: stay on 127.0.0.1 and put nginx with TLS "
                "in front (docs/how-to/reverse_proxy.md)");
        if (settings_.port == 0) {
            port_ = server_.bind_to_any_port(settings_.host);
        } else if (server_.bind_to_port(settings_.host, settings_.port)) {
            port_ = settings_.port;
        }
        if (port_ <= 0) {
            throw fault::IoError(
                settings_.host + ":" + std::to_string(settings_.port) +
                ": cannot be bound; is the port in use? choose another with --port");
        }
        // Debian's httplib listens with a backlog of 5: of fifty clients that connect at once, some
        // would wait a second or give up.
        ::listen(listening_, backlog);
    }

    HttpSettings settings_;
    Callers callers_;
    Router router_;
    std::atomic<bool> stopping_ = false;
    std::atomic<bool> ended_ = false;
    int port_ = -1;
    socket_t listening_ = INVALID_SOCKET;
    httplib::Server server_;
};

HttpServer::HttpServer(Service& service, HttpSettings settings)
    : implementation_(std::make_unique<Implementation>(service, std::move(settings))) {}
HttpServer::~HttpServer() = default;
int HttpServer::port() const { return implementation_->port(); }
void HttpServer::serve() { implementation_->serve(); }
void HttpServer::stop() { implementation_->stop(); }

}  // namespace breach::orchestrator
