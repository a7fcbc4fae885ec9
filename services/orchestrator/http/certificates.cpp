#include "services/orchestrator/http/certificates.hpp"

#include <openssl/err.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "core/fault/fault.hpp"

namespace breach::orchestrator {

namespace fs = std::filesystem;

namespace {

/// The first thing that OpenSSL has to say since it was last asked.
std::string reason() {
    std::array<char, 256> text{};
    const unsigned long code = ERR_get_error();
    ERR_clear_error();
    if (code == 0) return "no reason is known";
    ERR_error_string_n(code, text.data(), text.size());
    return text.data();
}

[[noreturn]] void refuse(const char* option, const fs::path& file, const std::string& cause,
                         const std::string& remedy) {
    throw fault::BadInput("command line", {{option, file.string() + " " + cause, remedy}});
}

void need_readable(const char* option, const fs::path& file) {
    if (fs::is_directory(file) || ::access(file.c_str(), R_OK) != 0)
        refuse(option, file,
               std::string("cannot be read: ") +
                   std::strerror(fs::is_directory(file) ? EISDIR : errno),
               "give a PEM file that the user of the service may read");
}

/// A key behind a password would wait for somebody at the terminal.
int no_password(char*, int, int, void*) { return -1; }

Certificates::Context context_of(const fs::path& certificate, const fs::path& key) {
    need_readable("--tls-cert", certificate);
    need_readable("--tls-key", key);
    ERR_clear_error();
    Certificates::Context context(SSL_CTX_new(TLS_server_method()), SSL_CTX_free);
    if (!context) throw fault::IoError("TLS cannot be begun: " + reason());
    SSL_CTX_set_min_proto_version(context.get(), TLS1_2_VERSION);
    SSL_CTX_set_options(context.get(), SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION);
    SSL_CTX_set_mode(context.get(),
                     SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER);
    SSL_CTX_set_default_passwd_cb(context.get(), no_password);
    if (SSL_CTX_use_certificate_chain_file(context.get(), certificate.c_str()) != 1)
        refuse("--tls-cert", certificate, "holds no usable certificate (" + reason() + ")",
               "give the certificate as PEM (-----BEGIN CERTIFICATE-----), followed by those "
               "between it "
               "and the authority");
    if (SSL_CTX_use_PrivateKey_file(context.get(), key.c_str(), SSL_FILETYPE_PEM) != 1) {
        const bool other = ERR_GET_REASON(ERR_peek_error()) == X509_R_KEY_VALUES_MISMATCH;
        if (other)
            refuse("--tls-key", key, "is not the key of the certificate in " + certificate.string(),
                   "give the two files that were made together");
        refuse("--tls-key", key, "holds no usable key (" + reason() + ")",
               "give the private key as PEM, without a password");
    }
    if (SSL_CTX_check_private_key(context.get()) != 1)
        refuse("--tls-key", key, "is not the key of the certificate in " + certificate.string(),
               "give the two files that were made together");
    const X509* own = SSL_CTX_get0_certificate(context.get());
    if (X509_cmp_current_time(X509_get0_notAfter(own)) < 0)
        spdlog::warn("{} has expired: clients will refuse it until it is renewed",
                     certificate.string());
    return context;
}

}  // namespace

Certificates::Certificates(fs::path certificate, fs::path key)
    : certificate_(std::move(certificate)),
      key_(std::move(key)),
      known_(written()),
      looked_(Clock::now()),
      context_(context_of(certificate_, key_)) {}

Certificates::Times Certificates::written() const {
    std::error_code error;
    const auto of_certificate = fs::last_write_time(certificate_, error);
    return {of_certificate, fs::last_write_time(key_, error)};
}

Certificates::Context Certificates::newest() {
    const std::lock_guard lock(mutex_);
    const auto now = Clock::now();
    if (now - looked_ < std::chrono::seconds(1)) return context_;
    looked_ = now;
    const Times times = written();
    if (times == known_) return context_;
    known_ = times;
    try {
        context_ = context_of(certificate_, key_);
        spdlog::info("{} was renewed", certificate_.string());
    } catch (const std::exception& error) {
        spdlog::error("{}; the certificate before this change stays in force", error.what());
    }
    return context_;
}

}  // namespace breach::orchestrator
