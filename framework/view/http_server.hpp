// Pages for a browser on this machine, and nobody else: HTTP on the loopback interface, at a free port, below a path that cannot be guessed.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace tack {

struct HttpRequest {
  bool post = false;  // else GET
  std::string path;   // behind the token: "" of the page itself, "news"
  std::map<std::string, std::string> query;
};

struct HttpAnswer {
  int status = 200;
  std::string type = "text/html; charset=utf-8";
  std::string body;
};

class HttpServer {
 public:
  // Called by several threads at once. What it throws is answered with 500.
  using Handler = std::function<HttpAnswer(const HttpRequest&)>;

  // Serves from here on. Whoever asks without the token, or by another name than this machine has for itself, gets an empty 404 or 403. Throws
  // InputError if there is no port to be had.
  explicit HttpServer(Handler handler);
  ~HttpServer();  // waits for what is being answered
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  const std::string& address() const;  // "http://127.0.0.1:PORT/TOKEN/"

 private:
  class Listener;
  std::unique_ptr<Listener> listener_;
};

}  // namespace tack
