#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/scratch_folder.hpp"

/// A headless Chromium driven over two pipes by the Chrome DevTools Protocol: requests are JSON
/// ended by a zero byte on its descriptor 3, answers and events come on 4.
class Browser {
 public:
    using Json = nlohmann::json;

    /// Where one is on this machine; "": nowhere.
    static std::string program() {
        for (const char* path :
             {"/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"}) {
            if (::access(path, X_OK) == 0) return path;
        }
        return "";
    }

    Browser() {
        std::signal(SIGPIPE, SIG_IGN);
        int to[2], from[2];
        if (::pipe(to) != 0 || ::pipe(from) != 0) throw std::runtime_error("no pipes");
        const std::string path = program(), profile = "--user-data-dir=" + folder_.path.string();
        child_ = ::fork();
        if (child_ == 0) {
            ::setpgid(0, 0);
            ::setenv("HOME", folder_.path.c_str(), 1);
            // Out of the way first: the pipes' own descriptors may be 3 and 4.
            const int in = ::fcntl(to[0], F_DUPFD, 50), out = ::fcntl(from[1], F_DUPFD, 50);
            ::dup2(in, 3);
            ::dup2(out, 4);
            ::dup2(::open("/dev/null", O_RDWR), 2);
            ::execl(path.c_str(), path.c_str(), "--headless", "--no-sandbox", "--disable-gpu",
                    "--disable-dev-shm-usage", "--no-first-run", "--disable-extensions",
                    "--remote-debugging-pipe", profile.c_str(), "about:blank", nullptr);
            ::_exit(127);
        }
        ::close(to[0]);
        ::close(from[1]);
        in_ = to[1];
        out_ = from[0];
        const Json target = call("Target.createTarget", {{"url", "about:blank"}});
        session_ = call("Target.attachToTarget",
                        {{"targetId", target["targetId"]}, {"flatten", true}})["sessionId"];
        for (const char* domain : {"Page", "Runtime", "Log"}) {
            call(std::string(domain) + ".enable");
        }
    }
    ~Browser() {
        ::close(in_);
        ::close(out_);
        ::kill(-child_, SIGKILL);
        int status = 0;
        ::waitpid(child_, &status, 0);
    }
    Browser(const Browser&) = delete;
    Browser& operator=(const Browser&) = delete;

    Json call(const std::string& method, const Json& parameters = Json::object()) {
        Json request{{"id", ++last_}, {"method", method}, {"params", parameters}};
        if (!session_.empty()) request["sessionId"] = session_;
        const std::string text = request.dump();
        for (std::size_t sent = 0; sent <= text.size();) {  // its zero byte too
            const ssize_t n = ::write(in_, text.c_str() + sent, text.size() + 1 - sent);
            if (n <= 0) throw std::runtime_error("the browser takes no more");
            sent += static_cast<std::size_t>(n);
        }
        for (;;) {
            Json answer = next();
            if (!answer.contains("id")) {
                note(std::move(answer));
            } else if (answer["id"] == last_) {
                if (answer.contains("error")) {
                    throw std::runtime_error(method + ": " + answer["error"].dump());
                }
                return answer["result"];
            }
        }
    }

    /// Loads a file at a screen of such a width; complaints are those of this page.
    void open(const std::filesystem::path& file, int width) {
        complaints.clear();
        loaded_ = false;
        call(
            "Emulation.setDeviceMetricsOverride",
            {{"width", width}, {"height", 900}, {"deviceScaleFactor", 1}, {"mobile", width < 600}});
        call("Page.navigate", {{"url", "file://" + file.string()}});
        while (!loaded_) note(next());
        evaluate("1");  // what the page has said before comes before its answer
    }

    Json evaluate(const std::string& expression) {
        const Json answer =
            call("Runtime.evaluate",
                 {{"expression", expression}, {"returnByValue", true}, {"awaitPromise", true}});
        if (answer.contains("exceptionDetails")) {
            throw std::runtime_error(expression + ": " + answer["exceptionDetails"].dump());
        }
        return answer["result"].value("value", Json());
    }

    /// What the console was reported, errors that nobody caught, what the browser refused: a line
    /// each.
    std::vector<std::string> complaints;

 private:
    Json next() {
        for (;;) {
            if (const std::size_t end = buffer_.find('\0'); end != std::string::npos) {
                Json message = Json::parse(buffer_.substr(0, end));
                buffer_.erase(0, end + 1);
                return message;
            }
            pollfd ready{.fd = out_, .events = POLLIN, .revents = 0};
            if (::poll(&ready, 1, 120000) <= 0) throw std::runtime_error("the browser is silent");
            std::string block(1 << 20, '\0');
            const ssize_t n = ::read(out_, block.data(), block.size());
            if (n <= 0) throw std::runtime_error("the browser has ended");
            buffer_.append(block, 0, static_cast<std::size_t>(n));
        }
    }
    void note(Json event) {
        const std::string method = event.value("method", "");
        if (method == "Page.loadEventFired") loaded_ = true;
        if (method == "Runtime.consoleAPICalled" || method == "Runtime.exceptionThrown" ||
            method == "Log.entryAdded") {
            complaints.push_back(event["params"].dump().substr(0, 500));
        }
    }

    ScratchFolder folder_{"browser"};
    pid_t child_ = -1;
    int in_ = -1, out_ = -1, last_ = 0;
    bool loaded_ = false;
    std::string session_, buffer_;
};
