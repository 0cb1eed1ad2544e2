#include "link/operator_link/testing/certificates.hpp"

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>
#include <stdlib.h>

#include <cstdio>
#include <memory>

#include "base/assert.hpp"

namespace lapwing::link::operator_link::testing {

namespace {

using Key = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;
using Certificate = std::unique_ptr<X509, decltype(&X509_free)>;

void extend(X509* certificate, int what, char const* value) {
  X509V3_CTX context;
  X509V3_set_ctx(&context, certificate, certificate, nullptr, nullptr, 0);
  auto* const extension = X509V3_EXT_conf_nid(nullptr, &context, what, value);
  LAPWING_ASSERT(extension != nullptr);
  X509_add_ext(certificate, extension, -1);
  X509_EXTENSION_free(extension);
}

Certificate make(EVP_PKEY* key, char const* name, int days) {
  constexpr long day = 24L * 3600;
  static long serial = 0;
  Certificate certificate(X509_new(), X509_free);
  X509_set_version(certificate.get(), 2);
  ASN1_INTEGER_set(X509_get_serialNumber(certificate.get()), ++serial);
  X509_gmtime_adj(X509_getm_notBefore(certificate.get()), -10 * day);
  X509_gmtime_adj(X509_getm_notAfter(certificate.get()), days * day);
  X509_set_pubkey(certificate.get(), key);
  X509_NAME_add_entry_by_txt(X509_get_subject_name(certificate.get()), "CN", MBSTRING_ASC,
                             reinterpret_cast<unsigned char const*>(name), -1, -1, 0);
  return certificate;
}

void save(std::filesystem::path const& file, X509* certificate, EVP_PKEY* key) {
  std::unique_ptr<std::FILE, decltype(&std::fclose)> const to(std::fopen(file.c_str(), "w"), std::fclose);
  LAPWING_ASSERT(to != nullptr);
  if (certificate != nullptr) PEM_write_X509(to.get(), certificate);
  if (key != nullptr) PEM_write_PrivateKey(to.get(), key, nullptr, nullptr, 0, nullptr, nullptr);
}

}  // namespace

struct Authority::Identity {
  Key key{EVP_EC_gen("P-256"), EVP_PKEY_free};
  Certificate certificate = make(key.get(), "Authority of a test", 1);
};

Authority::Authority() : identity_(new Identity) {
  char pattern[] = "/tmp/lapwing-authority-XXXXXX";
  LAPWING_ASSERT(::mkdtemp(pattern) != nullptr);
  folder_ = pattern;
  auto* const certificate = identity_->certificate.get();
  X509_set_issuer_name(certificate, X509_get_subject_name(certificate));
  extend(certificate, NID_basic_constraints, "critical,CA:TRUE");
  X509_sign(certificate, identity_->key.get(), EVP_sha256());
  save(file(), certificate, nullptr);
}

Authority::~Authority() {
  delete identity_;
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

Authority::Files Authority::sign(std::string const& file, Subject const& subject) {
  Key const key(EVP_EC_gen("P-256"), EVP_PKEY_free);
  auto const certificate = make(key.get(), file.c_str(), subject.days_from_now);
  X509_set_issuer_name(certificate.get(), X509_get_subject_name(identity_->certificate.get()));
  extend(certificate.get(), NID_subject_alt_name, subject.names.c_str());
  X509_sign(certificate.get(), identity_->key.get(), EVP_sha256());
  Files files{folder_ / (file + ".pem"), folder_ / (file + ".key")};
  save(files.certificate, certificate.get(), nullptr);
  save(files.key, nullptr, key.get());
  return files;
}

}  // namespace lapwing::link::operator_link::testing
