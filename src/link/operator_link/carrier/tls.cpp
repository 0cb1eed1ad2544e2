#include "link/operator_link/carrier/tls.hpp"

#include <arpa/inet.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>

#include <array>
#include <list>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/async/notifier.hpp"
#include "base/async/scope.hpp"

namespace lapwing::link::operator_link {

namespace {

using Context = std::shared_ptr<SSL_CTX>;

/// Connections whose handshake is under way; the oldest makes room for the newest.
constexpr std::size_t most_handshakes = 16;

std::string openssl_reason() {
  auto const code = ERR_get_error();
  ERR_clear_error();
  auto const* const reason = ERR_reason_error_string(code);
  return reason != nullptr ? reason : "no reason given";
}

std::unexpected<base::Error> bad_file(std::string_view what, std::filesystem::path const& file) {
  return base::fail(base::ErrorKind::invalid_input, fmt::format("{} {}: {}", what, file.string(), openssl_reason()),
                    "Give a readable PEM file; key and certificate must belong together.");
}

base::Result<Context> make_context(SSL_METHOD const* method) {
  Context context(SSL_CTX_new(method), SSL_CTX_free);
  if (!context) return base::fail(base::ErrorKind::io, fmt::format("no TLS: {}", openssl_reason()));
  SSL_CTX_set_min_proto_version(context.get(), TLS1_2_VERSION);
  return context;
}

base::Result<> take_certificate(SSL_CTX* context, std::filesystem::path const& certificate,
                                std::filesystem::path const& key) {
  ERR_clear_error();
  if (SSL_CTX_use_certificate_chain_file(context, certificate.c_str()) != 1)
    return bad_file("certificate", certificate);
  if (SSL_CTX_use_PrivateKey_file(context, key.c_str(), SSL_FILETYPE_PEM) != 1) return bad_file("key", key);
  return {};
}

base::Result<> take_authority(SSL_CTX* context, std::filesystem::path const& authority) {
  ERR_clear_error();
  if (SSL_CTX_load_verify_locations(context, authority.c_str(), nullptr) != 1) return bad_file("authority", authority);
  // A server's own certificate, without who signed it, is an authority for itself.
  X509_VERIFY_PARAM_set_flags(SSL_CTX_get0_param(context), X509_V_FLAG_PARTIAL_CHAIN);
  return {};
}

bool is_address(std::string const& host) {
  std::array<unsigned char, sizeof(in6_addr)> ignored;
  return inet_pton(AF_INET, host.c_str(), ignored.data()) == 1 ||
         inet_pton(AF_INET6, host.c_str(), ignored.data()) == 1;
}

/// TLS between two streams of bytes: what is read of one is cut out of the records of the other.
class TlsStream final : public ByteStream {
 public:
  using Ready = std::function<void(std::string why_not)>;

  /// A client's has a host to look for in the certificate.
  TlsStream(base::Loop& loop, std::unique_ptr<ByteStream> inner, SSL_CTX* context, std::optional<std::string> host)
      : loop_(loop), inner_(std::move(inner)), host_(std::move(host)), ssl_(SSL_new(context), SSL_free) {
    SSL_set_bio(ssl_.get(), BIO_new(BIO_s_mem()), BIO_new(BIO_s_mem()));
    if (host_)
      SSL_set_connect_state(ssl_.get());
    else
      SSL_set_accept_state(ssl_.get());
    if (!host_) return;
    if (is_address(*host_)) {
      X509_VERIFY_PARAM_set1_ip_asc(SSL_get0_param(ssl_.get()), host_->c_str());
    } else {
      SSL_set_tlsext_host_name(ssl_.get(), host_->c_str());
      SSL_set1_host(ssl_.get(), host_->c_str());
    }
  }

  /// Begins the handshake; `ready` is called once, with nothing to say when it has come about.
  void shake_hands(Ready ready) {
    ready_ = std::move(ready);
    inner_->start({.data = [this](Bytes bytes) { decrypt(bytes); },
                   .drained =
                       [this] {
                         auto const drained = events_.drained;
                         if (drained) drained();
                       },
                   .ended = [this](std::string why) { end(std::move(why)); }});
    step();
  }

  [[nodiscard]] std::string peer_name() const override { return inner_->peer_name(); }
  void start(Events events) override {
    events_ = std::move(events);
    // What came together with the last of the handshake, or its end.
    loop_.post([this, alive = std::weak_ptr(alive_)] {
      if (alive.expired()) return;
      if (ended_) return end(*std::exchange(ended_, std::nullopt));
      step();
    });
  }
  void write(Bytes bytes) override {
    if (bytes.empty() || is_closed_) return;
    ERR_clear_error();
    if (SSL_write(ssl_.get(), bytes.data(), static_cast<int>(bytes.size())) <= 0) return end_later(openssl_reason());
    send_records();
  }
  [[nodiscard]] std::size_t backlog() const override { return inner_->backlog(); }
  void pause(bool is_paused) override {
    is_paused_ = is_paused;
    inner_->pause(is_paused);
    if (is_paused) return;
    loop_.post([this, alive = std::weak_ptr(alive_)] {
      if (!alive.expired() && !is_closed_) step();
    });
  }
  void close() override {
    if (std::exchange(is_closed_, true)) return;
    events_ = {};
    ready_ = {};
    SSL_shutdown(ssl_.get());
    send_records();
    inner_->close();
  }

 private:
  void decrypt(Bytes bytes) {
    BIO_write(SSL_get_rbio(ssl_.get()), bytes.data(), static_cast<int>(bytes.size()));
    step();
  }

  /// As far as it goes with what has come.
  void step() {
    auto const alive = std::weak_ptr(alive_);
    while (!alive.expired() && !is_closed_) {
      ERR_clear_error();
      bool const is_shaken = SSL_is_init_finished(ssl_.get()) == 1;
      if (is_shaken && (is_paused_ || !events_.data)) break;
      std::array<std::uint8_t, 16 * 1024> plain;
      int const got = is_shaken ? SSL_read(ssl_.get(), plain.data(), plain.size()) : SSL_do_handshake(ssl_.get());
      if (got <= 0) {
        stopped(SSL_get_error(ssl_.get(), got));
        break;
      }
      if (!is_shaken) {
        send_records();
        told_ready({});
        continue;
      }
      auto const data = events_.data;
      data(Bytes(plain).first(static_cast<std::size_t>(got)));
    }
    if (!alive.expired() && !is_closed_) send_records();
  }

  void stopped(int reason) {
    send_records();  // an alert tells the far end why
    if (reason == SSL_ERROR_WANT_READ || reason == SSL_ERROR_WANT_WRITE) return;
    if (reason == SSL_ERROR_ZERO_RETURN) return end("closed by the far end");
    end(why_refused());
  }

  std::string why_refused() {
    auto const verified = SSL_get_verify_result(ssl_.get());
    auto const reason = openssl_reason();
    if (verified == X509_V_OK) return fmt::format("TLS: {}", reason);
    std::string const whose = host_ ? "the server's certificate" : "the client's certificate";
    if (verified == X509_V_ERR_HOSTNAME_MISMATCH || verified == X509_V_ERR_IP_ADDRESS_MISMATCH)
      return fmt::format("{} is not for '{}'", whose, host_.value_or(""));
    return fmt::format("{} is not accepted: {}", whose, X509_verify_cert_error_string(verified));
  }

  void send_records() {
    char* bytes = nullptr;
    auto* const out = SSL_get_wbio(ssl_.get());
    auto const size = BIO_get_mem_data(out, &bytes);
    if (size <= 0) return;
    inner_->write({reinterpret_cast<std::uint8_t const*>(bytes), static_cast<std::size_t>(size)});
    (void)BIO_reset(out);
  }

  void told_ready(std::string why_not) {
    if (auto const ready = std::exchange(ready_, {})) ready(std::move(why_not));
  }

  void end_later(std::string why) {
    loop_.post([this, why = std::move(why), alive = std::weak_ptr(alive_)] {
      if (!alive.expired()) end(why);
    });
  }

  void end(std::string why) {
    if (is_closed_) return;
    if (ready_) return told_ready(std::move(why));
    if (!events_.ended) {
      ended_ = std::move(why);  // nobody listens yet
      return;
    }
    is_closed_ = true;
    inner_->close();
    auto const ended = std::exchange(events_, {}).ended;
    ended(std::move(why));
  }

  base::Loop& loop_;
  std::unique_ptr<ByteStream> inner_;
  std::optional<std::string> host_;
  std::unique_ptr<SSL, decltype(&SSL_free)> ssl_;
  Ready ready_;
  Events events_;
  std::optional<std::string> ended_;
  bool is_paused_ = false;
  bool is_closed_ = false;
  std::shared_ptr<int> alive_ = std::make_shared<int>(0);
};

class TlsListener final : public Listener {
 public:
  TlsListener(base::Loop& loop, std::unique_ptr<Listener> inner, Context context, base::Duration timeout)
      : loop_(loop), inner_(std::move(inner)), context_(std::move(context)), timeout_(timeout), scope_(loop) {}

  [[nodiscard]] std::string name() const override { return inner_->name() + " (TLS)"; }
  [[nodiscard]] std::uint16_t port() const override { return inner_->port(); }
  void start(Accept accept) override {
    accept_ = std::move(accept);
    inner_->start([this](std::unique_ptr<ByteStream> stream) { scope_.spawn(let_in(std::move(stream))); });
  }

 private:
  struct Guest {
    std::unique_ptr<TlsStream> stream;
    bool is_over = false;
    bool is_in = false;
  };

  base::Task<> let_in(std::unique_ptr<ByteStream> inner) {
    auto const deadline = loop_.now() + timeout_;
    auto const guest = guests_.insert(
        guests_.end(), {std::make_unique<TlsStream>(loop_, std::move(inner), context_.get(), std::nullopt)});
    struct Leave {
      std::list<Guest>& guests;
      std::list<Guest>::iterator guest;
      ~Leave() { guests.erase(guest); }
    } const leave{guests_, guest};
    if (guests_.size() > most_handshakes) {
      guests_.front().is_over = true;
      changed_.notify_all();
    }
    guest->stream->shake_hands([this, guest](std::string const& why_not) {
      guest->is_over = true;
      guest->is_in = why_not.empty();
      changed_.notify_all();
    });
    while (!guest->is_over && loop_.now() < deadline) co_await changed_.wait_until(deadline);
    if (guest->is_in) accept_(std::move(guest->stream));
  }

  base::Loop& loop_;
  std::unique_ptr<Listener> inner_;
  Context context_;
  base::Duration timeout_;
  Accept accept_;
  std::list<Guest> guests_;
  base::Notifier changed_{loop_};
  base::Scope scope_;
};

class TlsDialler final : public Dialler {
 public:
  TlsDialler(base::Loop& loop, std::unique_ptr<Dialler> inner, Context context, std::string host,
             base::Duration timeout)
      : loop_(loop),
        inner_(std::move(inner)),
        context_(std::move(context)),
        host_(std::move(host)),
        timeout_(timeout) {}

  [[nodiscard]] std::string name() const override { return inner_->name() + " (TLS)"; }

  [[nodiscard]] base::Task<base::Result<std::unique_ptr<ByteStream>>> dial() override {
    auto inner_dial = inner_->dial();
    auto inner = co_await inner_dial;
    if (!inner) co_return std::unexpected(inner.error());
    auto stream = std::make_unique<TlsStream>(loop_, *std::move(inner), context_.get(), host_);
    std::optional<std::string> answer;
    base::Notifier ended(loop_);
    stream->shake_hands([&](std::string why_not) {
      answer = std::move(why_not);
      ended.notify_all();
    });
    auto const deadline = loop_.now() + timeout_;
    while (!answer && loop_.now() < deadline) co_await ended.wait_until(deadline);
    if (!answer)
      co_return base::fail(base::ErrorKind::timed_out, fmt::format("{} does not answer in TLS", inner_->name()),
                           "Look whether the far end speaks TLS on this port.");
    if (!answer->empty())
      co_return base::fail(base::ErrorKind::refused, fmt::format("{}: {}", inner_->name(), *answer),
                           "Look at the certificate, its names and dates, and at the authority that this end trusts.");
    co_return stream;
  }

 private:
  base::Loop& loop_;
  std::unique_ptr<Dialler> inner_;
  Context context_;
  std::string host_;
  base::Duration timeout_;
};

}  // namespace

base::Result<std::unique_ptr<Listener>> secure(base::Loop& loop, std::unique_ptr<Listener> listener,
                                               TlsServerSettings const& settings, base::Duration timeout) {
  auto context = make_context(TLS_server_method());
  if (!context) return std::unexpected(context.error());
  if (auto const fine = take_certificate(context->get(), settings.certificate, settings.key); !fine)
    return std::unexpected(fine.error());
  if (!settings.client_authority.empty()) {
    if (auto const fine = take_authority(context->get(), settings.client_authority); !fine)
      return std::unexpected(fine.error());
    SSL_CTX_set_verify(context->get(), SSL_VERIFY_PEER | SSL_VERIFY_FAIL_IF_NO_PEER_CERT, nullptr);
  }
  return std::make_unique<TlsListener>(loop, std::move(listener), *std::move(context), timeout);
}

base::Result<std::unique_ptr<Dialler>> secure(base::Loop& loop, std::unique_ptr<Dialler> dialler,
                                              std::string const& host, TlsClientSettings const& settings,
                                              base::Duration timeout) {
  auto context = make_context(TLS_client_method());
  if (!context) return std::unexpected(context.error());
  if (auto const fine = take_authority(context->get(), settings.authority); !fine) return std::unexpected(fine.error());
  if (!settings.certificate.empty())
    if (auto const fine = take_certificate(context->get(), settings.certificate, settings.key); !fine)
      return std::unexpected(fine.error());
  SSL_CTX_set_verify(context->get(), SSL_VERIFY_PEER, nullptr);
  return std::make_unique<TlsDialler>(loop, std::move(dialler), *std::move(context),
                                      settings.host_name.empty() ? host : settings.host_name, timeout);
}

}  // namespace lapwing::link::operator_link
