// Requests to the server over one connection that stays open. A refusal (4xx) becomes Refused,
// with the server's faults; 429, 5xx and a missing answer become Unreachable, after which a
// command may try again.
#include "services/cli/http/server.hpp"

#include <httplib.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

namespace breach::cli {

using nlohmann::json;

/// Here only, so that httplib is not compiled into every command.
struct Server::Connection {
    std::string origin;
    std::string prefix;
    httplib::Client client;
};

namespace {

/// TCP alone would try for minutes where a firewall drops the packets.
constexpr std::chrono::seconds patience_to_connect{5};
/// Longer than the longest wait for events that a command asks for.
constexpr std::chrono::seconds patience_for_an_answer = longest_poll + std::chrono::seconds(40);

/// Answers of a proxy may be any JSON, or none: a refusal must not end in a fault of reading it.
std::string text_or(const json& object, const char* key, const std::string& otherwise) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : otherwise;
}

std::vector<fault::Fault> faults_of(const json& problem) {
    std::vector<fault::Fault> faults;
    const auto found = problem.find("faults");
    if (found == problem.end() || !found->is_array()) return faults;
    for (const json& each : *found) {
        if (!each.is_object()) continue;
        faults.push_back({text_or(each, "pointer", ""), text_or(each, "cause", ""),
                          text_or(each, "remedy", "")});
    }
    return faults;
}

/// 429 and 5xx are about the moment, other statuses about the request.
[[noreturn]] void refuse(int status, const std::string& body) {
    json problem = json::parse(body, nullptr, false);
    if (!problem.is_object()) problem = json::object();
    const std::string title =
        text_or(problem, "title", "the server answered " + std::to_string(status));
    const std::string detail = text_or(problem, "detail", "");
    const std::string summary = detail.empty() ? title : title + ": " + detail;
    if (status == 429 || status >= 500) throw Unreachable(summary);
    throw Refused(status, summary, faults_of(problem), text_or(problem, "type", ""));
}

/// Something else than the server may answer 200 with HTML: a proxy's login page, for example.
json parsed(const std::string& body) {
    json answer = json::parse(body, nullptr, false);
    if (answer.is_discarded()) throw fault::IoError("the server's answer is not JSON");
    return answer;
}

}  // namespace

Server::Server(const Address& address, const std::optional<std::string>& token,
               const std::filesystem::path& authority)
    : connection_(new Connection{address.origin, address.prefix, httplib::Client(address.origin)}) {
    httplib::Client& client = connection_->client;
    client.set_keep_alive(true);
    client.set_tcp_nodelay(true);  // no delay of small requests (Nagle)
    client.set_connection_timeout(patience_to_connect);
    client.set_read_timeout(patience_for_an_answer);
    if (token) client.set_bearer_token_auth(*token);
    if (authority.empty()) return;
    // Checked here, where the file's name is known; good() only sees that nothing was loaded.
    if (!std::ifstream(authority) || std::filesystem::is_directory(authority))
        throw fault::IoError(authority.string() +
                             ": cannot be read; --tls-ca and BREACH_TLS_CA name a PEM file with "
                             "the authority's certificate");
    client.set_ca_cert_path(authority.c_str());
}

Server::~Server() = default;

namespace {

/// Why the certificate was rejected. verdict: OpenSSL's; if X509_V_OK, the name is wrong.
std::string fault_of_certificate(const std::string& origin, long verdict) {
    const std::string what = origin + ": its certificate is not to be trusted: ";
    switch (verdict) {
        case X509_V_OK:
            return what +
                   "it was made for another name; use an address that it names, or have it made "
                   "for this one";
        case X509_V_ERR_CERT_HAS_EXPIRED:
            return what +
                   "it has expired; whoever runs the service must renew it (and is this machine's "
                   "clock right?)";
        case X509_V_ERR_CERT_NOT_YET_VALID:
            return what + "it is not valid yet; is this machine's clock right?";
        case X509_V_ERR_DEPTH_ZERO_SELF_SIGNED_CERT:
        case X509_V_ERR_SELF_SIGNED_CERT_IN_CHAIN:
        case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT:
        case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT_LOCALLY:
        case X509_V_ERR_UNABLE_TO_VERIFY_LEAF_SIGNATURE:
            return what +
                   "its authority is not known here; if it is yours, name its certificate: "
                   "--tls-ca FILE or "
                   "BREACH_TLS_CA";
        default:
            return what + X509_verify_cert_error_string(verdict);
    }
}

/// The body of a successful answer; throws everything else.
const httplib::Response& good(const httplib::Result& result, const httplib::Client& client,
                              const std::string& origin) {
    if (result.error() == httplib::Error::SSLServerVerification)
        throw fault::IoError(fault_of_certificate(origin, client.get_openssl_verify_result()));
    if (result.error() == httplib::Error::SSLLoadingCerts)
        throw fault::IoError(
            "the file of --tls-ca or BREACH_TLS_CA holds no certificate; give the authority's as "
            "PEM");
    if (!result) {
        throw Unreachable("no answer from " + origin + " (" + httplib::to_string(result.error()) +
                          "): is `breachline serve` running there?");
    }
    if (result->status < 200 || result->status > 299) refuse(result->status, result->body);
    return *result;
}

}  // namespace

json Server::get(const std::string& path) { return parsed(get_text(path).body); }

TextAnswer Server::get_text(const std::string& path) {
    const auto result = connection_->client.Get(connection_->prefix + path);
    const httplib::Response& response = good(result, connection_->client, connection_->origin);
    TextAnswer answer{response.body, std::nullopt, response.get_header_value("X-Warning")};
    if (response.has_header("X-Next-Offset"))
        answer.next_offset = response.get_header_value("X-Next-Offset");
    return answer;
}

json Server::post(const std::string& path, const json& body, const Headers& headers) {
    const httplib::Headers sent(headers.begin(), headers.end());
    const auto result =
        connection_->client.Post(connection_->prefix + path, sent, body.dump(), "application/json");
    return parsed(good(result, connection_->client, connection_->origin).body);
}

json Server::remove(const std::string& path) {
    const auto result = connection_->client.Delete(connection_->prefix + path);
    return parsed(good(result, connection_->client, connection_->origin).body);
}

/// 404 is an answer here: how much of the file has arrived.
/// HEAD, as GET would send the whole file. Its answer has no body: the headers say all.
KnownFile Server::known_file(const std::string& path) {
    const auto result = connection_->client.Head(connection_->prefix + path);
    if (result && result->status == 404)
        return {{},
                std::strtoull(result->get_header_value("X-Arrived-Bytes").c_str(), nullptr, 10)};
    return {good(result, connection_->client, connection_->origin)
                .get_header_value("X-File-Reference")};
}

/// Reads the file in parts of 64 KiB, as it may be larger than memory.
/// A file that becomes shorter meanwhile ends the upload as Unreachable; send_file() tries again.
json Server::upload(const std::string& path, const std::filesystem::path& file, std::size_t from) {
    std::ifstream in(file, std::ios::binary);
    std::error_code error;
    const auto size = std::filesystem::file_size(file, error);
    if (!in || error) throw fault::IoError(file.string() + ": cannot be read");
    from = std::min<std::size_t>(from, size);
    const auto result = connection_->client.Post(
        connection_->prefix + path, size - from,
        [&](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
            std::vector<char> part(std::min<std::size_t>(length, 1 << 16));
            in.seekg(static_cast<std::streamoff>(from + offset));
            in.read(part.data(), static_cast<std::streamsize>(part.size()));
            const auto count = static_cast<std::size_t>(in.gcount());
            return count > 0 && sink.write(part.data(), count);
        },
        "application/octet-stream");
    return parsed(good(result, connection_->client, connection_->origin).body);
}

std::string Server::origin() const { return connection_->origin + connection_->prefix; }

/// The body of a refusal is kept apart: it must not become the file.
void Server::download(const std::string& path, const std::filesystem::path& file) {
    std::ofstream out(file, std::ios::binary | std::ios::trunc);
    int status = 0;
    std::string refusal;
    const auto result = connection_->client.Get(
        connection_->prefix + path,
        [&](const httplib::Response& response) {
            status = response.status;
            return true;
        },
        [&](const char* data, std::size_t size) {
            // The status comes before the body. Returning false ends the transfer: a full disk need
            // not wait for gigabytes.
            if (status == 200) {
                out.write(data, static_cast<std::streamsize>(size));
                return out.good();
            }
            refusal.append(data, size);
            return true;
        });
    out.close();
    if (!out) throw fault::IoError(file.string() + ": cannot be written (disk full?)");
    good(result, connection_->client, connection_->origin);
    if (status != 200) refuse(status, refusal);
}

}  // namespace breach::cli
