// By sockets, so that what is said is what stands here.
#include "framework/view/http_server.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
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
  // All that is answered until the other side closes, or for half a second.
  std::string said(const std::string& text) const {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{0, 500000};
    ::setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    std::string answer;
    if (::connect(socket, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0) {
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

TEST_CASE("what is asked below the token is answered, with what browsers are told to keep to") {
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

TEST_CASE("whoever lacks the token, or calls the machine otherwise, gets nothing") {
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
  CHECK_THAT(asked.get(asked.path, "", "PUT"), Catch::StartsWith("HTTP/1.1 405"));
}

TEST_CASE("what is no request, or too long a one, ends its connection and nothing else") {
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
