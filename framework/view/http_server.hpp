// HTTP server for a browser on this machine only: on the loopback interface, at a free port, below
// a random path.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace tack {

struct HttpRequest {
  bool post = false;  // else GET
  std::string path;   // path after the token: "" for the page itself, "news"
  std::map<std::string, std::string> query;
};

struct HttpAnswer {
  int status = 200;
  std::string type = "text/html; charset=utf-8";
  std::string body;
};

class HttpServer {
 public:
  // Called by several threads at once. An exception becomes status 500.
  using Handler = std::function<HttpAnswer(const HttpRequest&)>;

  // Starts to serve. Requests without the token, or for another host name than this machine's own,
  // get an empty 404 or 403. Throws InputError if no port is free.
  explicit HttpServer(Handler handler);
  ~HttpServer();  // waits for pending answers
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  const std::string& address() const;  // "http://127.0.0.1:PORT/TOKEN/"

 private:
  class Listener;
  std::unique_ptr<Listener> listener_;
};

}  // namespace tack
