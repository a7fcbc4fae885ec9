#include "services/orchestrator/http/http_server.hpp"

#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <thread>

#include "services/orchestrator/http/http_drawing.hpp"
#include "services/orchestrator/http/http_routes.hpp"

namespace breach::orchestrator {

namespace {

constexpr std::size_t threads = 256;  // one per connection, and streams of events hold theirs
constexpr std::size_t largest_body = 16 << 20;
constexpr std::size_t most_headers = 64;
constexpr std::size_t added_by_httplib = 4;  // REMOTE_ADDR and the like appear among the headers
constexpr std::size_t most_requests_per_connection = 1000;
constexpr int idle_seconds = 5;
constexpr int read_seconds = 10;
constexpr int write_seconds = 10;

bool is_loopback(const std::string& host) {
    return host == "localhost" || host == "::1" || host == "[::1]" || host.starts_with("127.");
}

std::string without_port(const std::string& host) {
    const std::size_t colon = host.rfind(':');
    if (colon == std::string::npos || host.find(']', colon) != std::string::npos) return host;
    return host.substr(0, colon);
}

/// Takes as long for any wrong token of this length.
bool equal_in_constant_time(const std::string& a, const std::string& b) {
    if (a.size() != b.size()) return false;
    unsigned difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
    return difference == 0;
}

/// Two readings of where this request ends: nothing after it on the connection can be trusted.
bool has_doubtful_end(const httplib::Request& request) {
    const auto lengths = request.get_header_value_count("Content-Length");
    const auto encodings = request.get_header_value_count("Transfer-Encoding");
    return lengths > 1 || encodings > 1 || (lengths > 0 && encodings > 0);
}

/// Writes the answer, a problem, and then fails on purpose, which makes httplib close the connection.
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
class Intake {
  public:
    Intake(const httplib::Request& request, const httplib::ContentReader* body) {
        if (body == nullptr) return;
        left_ = true;
        const bool form = request.is_multipart_form_data();
        reader_ = httplib::ContentReader(
            [this, body, form](httplib::ContentReceiver receive) {
                asked_ = true;
                // A form's parts are nothing that any path here takes.
                const bool whole =
                    form ? (*body)([](const httplib::MultipartFormData&) { return true; },
                                   [](const char*, std::size_t) { return true; })
                         : (*body)(std::move(receive));
                left_ = !whole;
                return whole;
            },
            nullptr);
    }

    /// Throws 413. What is too much is read for a while, so that its sender hears why.
    void keep_in(std::string& text) {
        if (!left_) return;
        std::size_t bytes = 0;
        const bool whole = reader_([&](const char* data, std::size_t size) {
            bytes += size;
            if (bytes <= largest_body) text.append(data, size);
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
    bool left_ = false;  ///< something may still come
    bool asked_ = false;
    httplib::ContentReader reader_{nullptr, nullptr};
};

Problem problem_of(int status) {
    if (status == 413) return too_large();
    return {status, "/problems/bad-request", "Bad request", "the request cannot be understood"};
}

}  // namespace

class HttpServer::Implementation {
  public:
    Implementation(Service& service, HttpSettings settings) : settings_(std::move(settings)) {
        add_run_routes(router_, service);
        add_accuracy_routes(router_, service);
        add_uncertainty_routes(router_, service);
        add_trigger_routes(router_, service);
        add_output_routes(router_, service);
        add_outflow_routes(router_, service);
        add_storage_routes(router_, service);
        add_file_routes(router_, service);
        add_scene_routes(router_, service);
        add_provenance_routes(router_, service);
        add_transfer_routes(router_, service);
        add_worker_routes(router_, service);
        add_event_routes(router_, service, stopping_);
        add_example_routes(router_, service);
        add_template_routes(router_, service);
        add_metric_routes(router_, service);
        add_page_routes(router_, service);
        add_drawing_routes(router_, service);
        set_limits();
        set_doors();
        bind();
    }

    int port() const { return port_; }
    void serve() {
        server_.listen_after_bind();
        ended_ = true;
    }
    void stop() {
        stopping_ = true;
        // httplib ignores a stop that comes before its loop has begun, and would then serve for
        // ever.
        constexpr auto moment = std::chrono::milliseconds(5);
        while (!ended_ && !server_.is_running()) std::this_thread::sleep_for(moment);
        server_.stop();
    }

  private:
    /// Debian's httplib listens with a backlog of 5: of fifty clients that knock at once, some would
    /// wait a second for their connection, or give up. Linux lets a listening socket's backlog be
    /// raised.
    class WideServer : public httplib::Server {
      public:
        void widen_backlog() const { ::listen(svr_sock_, 512); }
    };

    void set_limits() {
        server_.new_task_queue = [] { return new httplib::ThreadPool(threads); };
        server_.set_keep_alive_max_count(most_requests_per_connection);
        server_.set_keep_alive_timeout(idle_seconds);
        server_.set_read_timeout(read_seconds);
        server_.set_write_timeout(write_seconds);
        server_.set_tcp_nodelay(true);
        // Not httplib's default, which lets a second service share the port.
        server_.set_socket_options([](socket_t socket) {
            const int on = 1;
            setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
        });
        server_.set_default_headers({{"X-Content-Type-Options", "nosniff"}});
    }

    void set_doors() {
        server_.set_pre_routing_handler(
            [this](const httplib::Request& request, httplib::Response& response) {
                // Only artifacts come in parts; hundreds of ranges would multiply any other answer.
                const bool parts = (request.path.starts_with("/v1/artifacts/") ||
                                    request.path.starts_with("/v1/files/")) &&
                                   request.ranges.size() == 1;
                if (!parts) const_cast<httplib::Request&>(request).ranges.clear();
                if (has_doubtful_end(request)) {
                    refuse_and_close(response, bad_request("the request's length is given twice"));
                    return httplib::Server::HandlerResponse::Handled;
                }
                // A request that announces no body has none; httplib would wait for one.
                const bool bodiless = request.method == "GET" || request.method == "HEAD" ||
                                      request.method == "OPTIONS";
                if (bodiless || request.has_header("Content-Length") ||
                    request.has_header("Transfer-Encoding"))
                    return httplib::Server::HandlerResponse::Unhandled;
                answer(request, response, nullptr);
                return httplib::Server::HandlerResponse::Handled;
            });
        const httplib::Server::Handler door = [this](const httplib::Request& request,
                                                     httplib::Response& response) {
            answer(request, response, nullptr);
        };
        const httplib::Server::HandlerWithContentReader door_with_body =
            [this](const httplib::Request& request, httplib::Response& response,
                   const httplib::ContentReader& body) { answer(request, response, &body); };
        server_.Get(".*", door);
        server_.Options(".*", door);
        server_.Post(".*", door_with_body);
        server_.Put(".*", door_with_body);
        server_.Patch(".*", door_with_body);
        server_.Delete(".*", door_with_body);
        server_.set_error_handler([](const httplib::Request&, httplib::Response& response) {
            if (response.body.empty() && !response.content_provider_)
                refuse(response, problem_of(response.status));
        });
        server_.set_exception_handler([](const httplib::Request&, httplib::Response& response,
                                         std::exception_ptr) {
            refuse(response,
                   {500, "/problems/internal", "Internal fault", "the service's log says more"});
        });
    }

    /// A body is kept in memory only where it is small. One that is not read to its end would pass for
    /// the connection's next request: the connection is closed then.
    void answer(const httplib::Request& request, httplib::Response& response,
                const httplib::ContentReader* body) const {
        Intake intake(request, body);
        try {
            admit(request, response);
            const bool streamed = request.method == "POST" && request.path == "/v1/files";
            if (!streamed) intake.keep_in(const_cast<httplib::Request&>(request).body);
            router_.answer(request, response, streamed ? intake.reader() : nullptr);
        } catch (const Problem& problem) {
            refuse(response, problem);
        }
        if (!intake.is_at_its_end()) close_after(response);
    }

    /// Who may ask at all.
    void admit(const httplib::Request& request, httplib::Response& response) const {
        if (request.headers.size() > most_headers + added_by_httplib)
            throw Problem{431, "/problems/too-many-headers", "Too many headers",
                          "at most 64 are read"};
        if (request.get_header_value("Range").find(',') != std::string::npos)
            throw Problem{416, "/problems/range", "Range not satisfiable", "one range at a time"};
        const std::string host = request.get_header_value("Host");
        // A web page elsewhere could reach a service on loopback through its reader's browser.
        if (settings_.token.empty() && !is_loopback(without_port(host)))
            throw Problem{421, "/problems/misdirected", "Misdirected request",
                          "without a token the service answers only as localhost"};
        const std::string origin = request.get_header_value("Origin");
        if (!origin.empty() && origin != "http://" + host && origin != "https://" + host)
            throw Problem{403, "/problems/foreign-origin", "Forbidden",
                          "only the service's own pages may ask from a browser"};
        const bool protected_path = request.path.starts_with("/v1/");
        if (settings_.token.empty() || !protected_path) return;
        const std::string given = request.get_header_value("Authorization");
        if (equal_in_constant_time(given, "Bearer " + settings_.token)) return;
        response.set_header("WWW-Authenticate", "Bearer");
        throw Problem{401, "/problems/unauthorized", "Unauthorized",
                      "send the service's token: Authorization: Bearer ..."};
    }

    void bind() {
        if (settings_.token.empty() && !is_loopback(settings_.host)) {
            throw fault::BadInput(
                "command line",
                {{"--host",
                  settings_.host + " can be reached from other machines, and there is "
                                   "no token",
                  "give --token-file FILE, or stay on 127.0.0.1"}});
        }
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
        server_.widen_backlog();
    }

    HttpSettings settings_;
    Router router_;
    std::atomic<bool> stopping_ = false;
    std::atomic<bool> ended_ = false;
    int port_ = -1;
    WideServer server_;
};

HttpServer::HttpServer(Service& service, HttpSettings settings)
    : implementation_(std::make_unique<Implementation>(service, std::move(settings))) {}
HttpServer::~HttpServer() = default;
int HttpServer::port() const { return implementation_->port(); }
void HttpServer::serve() { implementation_->serve(); }
void HttpServer::stop() { implementation_->stop(); }

}  // namespace breach::orchestrator
