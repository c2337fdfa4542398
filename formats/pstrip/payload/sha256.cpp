#include <openssl/evp.h>

#include <memory>
#include <new>

#include "formats/pstrip/payload/digest.h"

namespace pstrips::inline formats {
namespace {

class OpensslSha256 final : public Sha256 {
 public:
  // Fails only when OpenSSL cannot allocate or has no SHA-256 at all.
  OpensslSha256() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1)
      throw std::bad_alloc();
  }

  void add(ByteView bytes) override {
    EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size());
  }
  Digest finish() override {
    Digest out;
    EVP_DigestFinal_ex(context_.get(), reinterpret_cast<unsigned char*>(out.data()), nullptr);
    return out;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

Digest digest(const Mesh& decoded) {
  OpensslSha256 sha256;
  return digest(decoded, sha256);
}

}  // namespace pstrips::inline formats
