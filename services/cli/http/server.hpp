// HTTP client for the server. No other file of this program uses HTTP.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/fault/fault.hpp"
#include "services/cli/address.hpp"

namespace breach::cli {

/// The server does not answer, or cannot at the moment (429 and 5xx).
class Unreachable : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The server refused the request (4xx): problem+json, RFC 9457.
class Refused : public std::runtime_error {
  public:
    Refused(int status, const std::string& summary, std::vector<fault::Fault> faults,
            std::string type = {})
        : std::runtime_error(summary),
          status_(status),
          faults_(std::move(faults)),
          type_(std::move(type)) {}
    int status() const { return status_; }
    /// "/problems/..."; empty: the answer has none.
    const std::string& type() const { return type_; }
    const std::vector<fault::Fault>& faults() const { return faults_; }

  private:
    int status_;
    std::vector<fault::Fault> faults_;
    std::string type_;
};

struct TextAnswer {
    std::string body;
    std::optional<std::string> next_offset;  ///< header X-Next-Offset
    std::string warning;                     ///< header X-Warning; empty: none
};

struct KnownFile {
    std::string reference;    ///< name in scenes; empty: the file is incomplete
    std::size_t arrived = 0;  ///< bytes received of an incomplete file
};

using Headers = std::map<std::string, std::string>;

/// Every call throws Unreachable, Refused, or IoError when the answer violates the API.
class Server {
  public:
    /// authority: PEM file of the trusted certificate authorities; empty: those of the system.
    Server(const Address& address, const std::optional<std::string>& token,
           const std::filesystem::path& authority = {});
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    nlohmann::json get(const std::string& path);
    TextAnswer get_text(const std::string& path);
    nlohmann::json post(const std::string& path, const nlohmann::json& body,
                        const Headers& headers = {});
    nlohmann::json remove(const std::string& path);
    KnownFile known_file(const std::string& path);
    /// Streams the file to the server, beginning at the byte `from`.
    nlohmann::json upload(const std::string& path, const std::filesystem::path& file,
                          std::size_t from);
    /// "http://host:port", with the prefix.
    std::string origin() const;
    /// Streams the answer into a file, as it may be larger than memory.
    void download(const std::string& path, const std::filesystem::path& file);

  private:
    struct Connection;
    std::unique_ptr<Connection> connection_;
};

/// Longest poll that a command may ask for; the client's time limit is longer. The server would
/// keep one open for up to 60 s.
inline constexpr std::chrono::seconds longest_poll{20};

}  // namespace breach::cli
