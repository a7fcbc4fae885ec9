// SHA-256 of inputs (provenance, cache keys, sent files) and of secrets (tokens). Declared in
// provenance.hpp.
#include <openssl/evp.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>

#include "core/exchange/provenance.hpp"
#include "core/fault/fault.hpp"

namespace breach::exchange {
namespace {

class Sha256 {
  public:
    Sha256() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
        EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr);
    }
    void add(const char* bytes, std::size_t count) {
        EVP_DigestUpdate(context_.get(), bytes, count);
    }
    std::string hexadecimal() {
        std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
        unsigned int length = 0;
        EVP_DigestFinal_ex(context_.get(), digest.data(), &length);
        constexpr char digits[] = "0123456789abcdef";
        std::string text;
        for (unsigned int i = 0; i < length; ++i) {
            text += digits[digest[i] >> 4];
            text += digits[digest[i] & 15];
        }
        return text;
    }

  private:
    std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

std::string sha256_of_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw fault::IoError(path.string() + ": cannot be opened: " + std::strerror(errno));
    Sha256 sha256;
    // In blocks: a snapshot may be larger than the memory that is free.
    std::array<char, 1 << 16> block;
    do {
        file.read(block.data(), block.size());
        sha256.add(block.data(), static_cast<std::size_t>(file.gcount()));
    } while (file);
    if (file.bad() || !file.eof())
        throw fault::IoError(path.string() + ": cannot be read to its end");
    return sha256.hexadecimal();
}

std::string sha256_of_text(const std::string& text) {
    Sha256 sha256;
    sha256.add(text.data(), text.size());
    return sha256.hexadecimal();
}

bool is_sha256(const std::string& text) {
    return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

}  // namespace breach::exchange
