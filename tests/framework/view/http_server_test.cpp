// The HTTP server through sockets, with requests byte for byte.
#include "framework/view/http_server.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <thread>

using namespace tack;

namespace {

struct Asked {
  explicit Asked(const HttpServer& server) {
    const std::string& address = server.address();
    const size_t colon = address.rfind(':'), slash = address.find('/', colon);
    port = std::stoi(address.substr(colon + 1, slash - colon - 1));
    path = address.substr(slash);
  }
  bool connect(int socket) const {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval idle_timeout{0, 500000};
    ::setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &idle_timeout, sizeof idle_timeout);
    return ::connect(socket, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
  }
  // A socket; -1 if there is no connection.
  int connected() const {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    if (connect(socket)) return socket;
    ::close(socket);
    return -1;
  }
  // All that is answered until the other side closes, or for half a second.
  std::string said(const std::string& text) const {
    const int socket = connected();
    std::string answer;
    if (socket >= 0) {
      ::send(socket, text.data(), text.size(), MSG_NOSIGNAL);
      char part[4096];
      for (ssize_t n = 0; (n = ::recv(socket, part, sizeof part, 0)) > 0;) answer.append(part, static_cast<size_t>(n));
    }
    ::close(socket);
    return answer;
  }
  std::string get(const std::string& target, const std::string& more = "", const std::string& method = "GET") const {
    return said(fmt::format("{} {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\n{}\r\n", method, target, port, more));
  }
  static std::string body(const std::string& answer) {
    const size_t end = answer.find("\r\n\r\n");
    return end == answer.npos ? "" : answer.substr(end + 4);
  }

  int port = 0;
  std::string path;
};

HttpAnswer echo(const HttpRequest& request) {
  if (request.path == "fail") throw std::runtime_error("it broke");
  std::string query;
  for (const auto& [key, value] : request.query) query += fmt::format(" {}={}", key, value);
  return {200, "text/plain", fmt::format("{} '{}'{}", request.post ? "post" : "get", request.path, query)};
}

}  // namespace

TEST_CASE("requests below the token are answered, with security headers") {
  const HttpServer server(echo);
  const Asked asked(server);
  CHECK(Asked::body(asked.get(asked.path)) == "get ''");
  CHECK(Asked::body(asked.get(asked.path + "news?steps=3&ended=&x")) == "get 'news' ended= steps=3 x=");
  CHECK(Asked::body(asked.get(asked.path + "stop", "Content-Length: 0\r\n", "POST")) == "post 'stop'");
  const std::string broken = asked.get(asked.path + "fail");
  CHECK_THAT(broken, Catch::StartsWith("HTTP/1.1 500"));
  CHECK(Asked::body(broken) == "it broke");
  for (const char* header : {"Cache-Control: no-store", "X-Content-Type-Options: nosniff", "Referrer-Policy: no-referrer", "X-Frame-Options: DENY"})
    CHECK_THAT(asked.get(asked.path), Catch::Contains(header));
}

TEST_CASE("requests without the token, or for another host name, get nothing") {
  const HttpServer server(echo), other(echo);
  const Asked asked(server), elsewhere(other);
  CHECK(asked.path != elsewhere.path);
  CHECK(asked.port != elsewhere.port);
  std::string near = asked.path;
  near[1] = near[1] == '0' ? '1' : '0';
  for (const std::string& target : {std::string("/"), near, elsewhere.path, asked.path.substr(0, asked.path.size() - 1), asked.path.substr(1), "/" + asked.path, std::string("*")}) {
    CAPTURE(target);
    const std::string answer = asked.get(target);
    CHECK((answer.empty() || answer.starts_with("HTTP/1.1 40")));
    CHECK(Asked::body(answer).empty());
  }
  for (const char* host : {"example.org", "127.0.0.1", "127.0.0.1:1", ""}) {
    CAPTURE(host);
    const std::string answer = asked.said(fmt::format("GET {} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n\r\n", asked.path, host));
    CHECK_THAT(answer, Catch::StartsWith("HTTP/1.1 403"));
    CHECK(Asked::body(answer).empty());
  }
  CHECK_THAT(asked.get(asked.path, "Origin: http://example.org\r\n"), Catch::StartsWith("HTTP/1.1 403"));
  CHECK_THAT(asked.get(asked.path, fmt::format("Origin: http://localhost:{}\r\n", asked.port)), Catch::StartsWith("HTTP/1.1 200"));
  for (const char* scheme : {"xxxxxxx", "https:/", ""}) CHECK_THAT(asked.get(asked.path, fmt::format("Origin: {}127.0.0.1:{}\r\n", scheme, asked.port)), Catch::StartsWith("HTTP/1.1 403"));
  CHECK_THAT(asked.get(asked.path, "", "PUT"), Catch::StartsWith("HTTP/1.1 405"));
}

TEST_CASE("an invalid or too long request ends its connection only") {
  const HttpServer server(echo);
  const Asked asked(server);
  std::mt19937 random(7);
  for (int i = 0; i < 20; ++i) {
    std::string noise(200, '\0');
    for (char& c : noise) c = static_cast<char>(random());
    CHECK_THAT(asked.said(noise + "\r\n\r\n"), !Catch::Contains("get '"));
  }
  CHECK_THAT(asked.get(asked.path, "X: " + std::string(20000, 'x') + "\r\n"), !Catch::Contains("get '"));
  CHECK_THAT(asked.get(asked.path + "stop", "Content-Length: 5000\r\n", "POST"), !Catch::Contains("post"));
  CHECK(asked.said("").empty());
  std::vector<std::thread> many;
  std::atomic<int> answered = 0;
  for (int i = 0; i < 16; ++i) many.emplace_back([&] { answered += Asked::body(asked.get(asked.path)) == "get ''"; });
  for (std::thread& one : many) one.join();
  CHECK(answered == 16);
}

TEST_CASE("silent connections exhaust neither the server nor the descriptors of the run") {
  const auto descriptors = [] { return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), std::filesystem::directory_iterator()); };
  const HttpServer server(echo);
  const Asked asked(server);
  const auto before = descriptors();
  std::vector<int> silent;
  for (int i = 0; i < 200; ++i) {
    silent.push_back(asked.connected());
    REQUIRE(silent.back() >= 0);
  }
  CHECK(Asked::body(asked.get(asked.path)) == "get ''");
  const auto own = descriptors() - before - static_cast<std::ptrdiff_t>(silent.size());  // the server's ends
  CHECK(own > 0);
  CHECK(own <= 40);
  for (const int socket : silent) ::close(socket);
  CHECK(Asked::body(asked.get(asked.path)) == "get ''");
}

TEST_CASE("a server without free descriptors waits without using the processor") {
  const HttpServer server(echo);
  const Asked asked(server);
  rlimit usual{};
  REQUIRE(::getrlimit(RLIMIT_NOFILE, &usual) == 0);
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);  // the lowest number that is free: there is no other below the limit
  const rlimit none{static_cast<rlim_t>(socket + 1), usual.rlim_max};
  REQUIRE(::setrlimit(RLIMIT_NOFILE, &none) == 0);
  CHECK(asked.connect(socket));
  const std::clock_t start = std::clock();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  const double worked = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  ::setrlimit(RLIMIT_NOFILE, &usual);
  ::close(socket);
  CHECK(worked < 0.2);
  CHECK(Asked::body(asked.get(asked.path)) == "get ''");
}
