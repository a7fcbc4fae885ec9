// The service's HTTP server: sizes, hardening, tokens, routes. nginx handles TLS, slow clients and
// rate limits (docs/how-to/reverse_proxy.md). Only the HTTP folders use cpp-httplib.
#pragma once

#include <memory>
#include <string>

#include "services/orchestrator/http/service.hpp"

namespace breach::orchestrator {

struct HttpSettings {
    std::string host = "127.0.0.1";
    int port = 0;  ///< 0: any free one
    std::string
        token;  ///< the admin's; neither this nor `tokens`: open to all, which only loopback allows
    std::filesystem::path tokens;  ///< file of named tokens (access/tokens.hpp); empty: none
};

class HttpServer {
  public:
    /// Binds. Throws IoError when it cannot, BadInput when the host is not loopback and there is no
    /// token, or when the tokens' file is invalid.
    HttpServer(Service& service, HttpSettings settings);
    ~HttpServer();
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;

    int port() const;
    /// Serves until stop().
    void serve();
    /// Callable from another thread.
    void stop();

  private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace breach::orchestrator
