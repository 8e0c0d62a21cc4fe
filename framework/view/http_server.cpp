// The only file that includes Boost.Beast.
#include "framework/view/http_server.hpp"

#include <fmt/format.h>
#include <sys/random.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <list>
#include <optional>
#include <string_view>
#include <thread>
#include <vector>

#include "geometry/errors.hpp"

namespace tack {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using Tcp = asio::ip::tcp;
using Request = http::request<http::string_body>;
using Response = http::response<http::string_body>;

constexpr int threads = 2;  // two, so that a slow page does not delay a request to stop the run
// Time limits of the next request of a connection, and of its first.
constexpr std::chrono::seconds idle_timeout{30}, first_timeout{5};
// Pause after a connection that the system refused.
constexpr std::chrono::milliseconds accept_pause{200};
constexpr std::size_t connection_count_max = 32;  // open at a time
constexpr std::size_t header_size_max = 8192, body_size_max = 1024;

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) throw InputError("the system has no random numbers to make an address of");
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

// Limits connections (a browser opens up to six) to an eighth of the process's file descriptors,
// because a run in the process needs them for its files.
std::size_t connection_limit() {
  rlimit descriptors{};
  if (::getrlimit(RLIMIT_NOFILE, &descriptors) != 0 || descriptors.rlim_cur == RLIM_INFINITY) return connection_count_max;
  return std::clamp<std::size_t>(descriptors.rlim_cur / 8, 2, connection_count_max);
}

// Compares in constant time.
bool same(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned char different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) different = static_cast<unsigned char>(different | (a[i] ^ b[i]));
  return different == 0;
}

// Parses "a=1&b=2". Values are numbers and plain words, without encoding.
std::map<std::string, std::string> query_of(std::string_view text) {
  std::map<std::string, std::string> query;
  while (!text.empty()) {
    const std::string_view one = text.substr(0, text.find('&'));
    const std::size_t at = one.find('=');
    query[std::string(one.substr(0, at))] = at == one.npos ? "" : std::string(one.substr(at + 1));
    text.remove_prefix(std::min(text.size(), one.size() + 1));
  }
  return query;
}

struct Site {
  HttpServer::Handler handler;
  std::string token;
  std::vector<std::string> hosts;  // own host names

  bool ours(std::string_view name) const { return std::find(hosts.begin(), hosts.end(), name) != hosts.end(); }
  // Returns true for paths "/TOKEN/...".
  bool has_token(std::string_view path) const {
    return path.size() >= token.size() + 2 && path[0] == '/' && path[token.size() + 1] == '/' && same(path.substr(1, token.size()), token);
  }

  HttpAnswer answer(const Request& request) const {
    const auto text = [&](http::field field) { return std::string(request[field]); };
    const std::string host = text(http::field::host), origin = text(http::field::origin);
    // Rejects pages of other sites: one whose name resolves to this machine has another host; one
    // that makes the browser send requests has another origin.
    constexpr std::string_view scheme = "http://";
    const bool from_here = origin.empty() || origin == "null" || (origin.starts_with(scheme) && ours(std::string_view(origin).substr(scheme.size())));
    if (!ours(host) || !from_here) return {403, "text/plain", ""};
    const std::string target(request.target());
    const std::string path = target.substr(0, target.find('?'));
    if (!has_token(path)) return {404, "text/plain", ""};
    const bool post = request.method() == http::verb::post;
    if (!post && request.method() != http::verb::get) return {405, "text/plain", ""};
    if (post && origin == "null") return {403, "text/plain", ""};
    HttpRequest asked{post, path.substr(token.size() + 2), {}};
    if (const std::size_t at = target.find('?'); at != target.npos) asked.query = query_of(std::string_view(target).substr(at + 1));
    try {
      return handler(asked);
    } catch (const std::exception& error) {
      return {500, "text/plain; charset=utf-8", error.what()};
    }
  }
};

Response response_of(const Request& request, HttpAnswer answer) {
  Response response(static_cast<http::status>(answer.status), request.version());
  response.set(http::field::content_type, answer.type);
  response.set(http::field::cache_control, "no-store");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  response.set("X-Frame-Options", "DENY");
  response.keep_alive(request.keep_alive());
  response.body() = std::move(answer.body);
  response.prepare_payload();
  return response;
}

// A browser's connection: request, answer, next request.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Tcp::socket socket, const Site& site) : stream_(std::move(socket)), site_(site) {}

  bool authenticated() const { return authenticated_; }  // true once it has sent the token

  // Callable by any thread.
  void drop() {
    asio::post(stream_.get_executor(), [self = shared_from_this()] { self->stream_.close(); });
  }

  void read() {
    parser_.emplace();
    parser_->header_limit(header_size_max);
    parser_->body_limit(body_size_max);
    stream_.expires_after(authenticated_ ? idle_timeout : first_timeout);
    http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) self->close();
      else self->write();
    });
  }

 private:
  void write() {
    const Request request = parser_->release();
    if (site_.has_token(std::string_view(request.target().data(), request.target().size()))) authenticated_ = true;
    response_ = response_of(request, site_.answer(request));
    stream_.expires_after(idle_timeout);
    http::async_write(stream_, *response_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error || self->response_->need_eof()) self->close();
      else self->read();
    });
  }
  void close() {
    beast::error_code none;
    stream_.socket().shutdown(Tcp::socket::shutdown_send, none);
  }

  beast::tcp_stream stream_;
  const Site& site_;
  std::atomic<bool> authenticated_ = false;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  std::optional<Response> response_;
};

}  // namespace

class HttpServer::Listener {
 public:
  explicit Listener(Handler handler) : site_{std::move(handler), random_token(), {}} {
    try {
      const Tcp::endpoint loopback(asio::ip::address_v4::loopback(), 0);
      acceptor_.open(loopback.protocol());
      acceptor_.bind(loopback);
      acceptor_.listen();
    } catch (const boost::system::system_error& error) {
      throw InputError(fmt::format("no port of this machine (127.0.0.1) can be served from: {}", error.what()));
    }
    const auto port = acceptor_.local_endpoint().port();
    site_.hosts = {fmt::format("127.0.0.1:{}", port), fmt::format("localhost:{}", port)};
    address_ = fmt::format("http://127.0.0.1:{}/{}/", port, site_.token);
    accept();
    for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { context_.run(); });
  }
  ~Listener() {
    context_.stop();
    for (std::thread& thread : threads_) thread.join();
  }
  const std::string& address() const { return address_; }

 private:
  // Accepts one connection at a time; nothing else accesses open_.
  void accept() {
    acceptor_.async_accept(asio::make_strand(context_), [this](beast::error_code error, Tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (error) {  // such as a lack of descriptors: idle connections are closed meanwhile
        pause_.expires_after(accept_pause);
        pause_.async_wait([this](beast::error_code aborted) {
          if (!aborted) accept();
        });
        return;
      }
      drop_excess_connections();
      const auto connection = std::make_shared<Connection>(std::move(socket), site_);
      open_.push_back(connection);
      connection->read();
      accept();
    });
  }

  // Drops connections to stay below the limit: the oldest, but first those that have not sent the
  // token.
  void drop_excess_connections() {
    std::erase_if(open_, [](const std::weak_ptr<Connection>& c) { return c.expired(); });
    while (open_.size() >= limit_) {
      const auto without_token = std::find_if(open_.begin(), open_.end(), [](const std::weak_ptr<Connection>& c) {
        const auto connection = c.lock();
        return connection && !connection->authenticated();
      });
      const auto oldest = without_token != open_.end() ? without_token : open_.begin();
      if (const auto connection = oldest->lock()) connection->drop();
      open_.erase(oldest);
    }
  }

  Site site_;
  asio::io_context context_{threads};
  Tcp::acceptor acceptor_{context_};
  asio::steady_timer pause_{context_};
  const std::size_t limit_ = connection_limit();
  std::list<std::weak_ptr<Connection>> open_;  // oldest first
  std::string address_;
  std::vector<std::thread> threads_;
};

HttpServer::HttpServer(Handler handler) : listener_(std::make_unique<Listener>(std::move(handler))) {}
HttpServer::~HttpServer() = default;
const std::string& HttpServer::address() const { return listener_->address(); }

}  // namespace tack
