// The service's certificate and key for TLS, read anew when they are renewed on the disk.
#pragma once

#include <openssl/ssl.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>

namespace breach::orchestrator {

class Certificates {
  public:
    using Context = std::shared_ptr<SSL_CTX>;

    /// PEM; certificate: with those between it and the authority. Throws BadInput: which file cannot be used, and why.
    Certificates(std::filesystem::path certificate, std::filesystem::path key);

    /// For one more connection. The files are looked at at most once a second; a pair that cannot be used (renewed by
    /// half) leaves the one before it in force, and the log says so.
    Context newest();

  private:
    using Clock = std::chrono::steady_clock;
    using Times = std::pair<std::filesystem::file_time_type, std::filesystem::file_time_type>;
    Times written() const;

    std::filesystem::path certificate_;
    std::filesystem::path key_;
    std::mutex mutex_;
    Times known_;
    Clock::time_point looked_;
    Context context_;
};

}  // namespace breach::orchestrator
