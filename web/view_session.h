#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "base/interrupt.h"
#include "web/view_drawer.h"
#include "web/view_message.h"

namespace burin {

/// An answer to a page. Text is JSON; bytes are the length of a JSON text (4 bytes, lowest first), that text, and what
/// it describes, a picture or a file.
struct ViewAnswer {
    std::string bytes;
    bool is_text = false;
};

/// ViewSession is what one page sees of a scene. Messages come in, answers go out; a thread of its own draws. Of views
/// that wait, only the newest one is drawn, and a picture in full quality is given up when another view comes.
class ViewSession {
  public:
    using Send = std::function<void(ViewAnswer answer)>;

    /// `send`: called by the session's thread, until it is stopped.
    ViewSession(ViewedScene& scene, Send send);
    /// Stops, and waits until nothing is drawn any more.
    ~ViewSession();
    ViewSession(const ViewSession&) = delete;
    ViewSession& operator=(const ViewSession&) = delete;

    /// Takes a message, and does not wait for what it asks for. What is wrong with it is answered.
    void receive(std::string_view message);
    /// Has drawing end soon.
    void stop();
    /// After stop(): whether its thread has ended.
    bool is_done() const { return is_done_.load(); }

  private:
    void work();
    std::optional<ViewMessage> next_message();
    void answer(const ViewMessage& message);
    void draw(const ViewMessage& message);
    void look(const ViewMessage& message);
    void explain(const ViewMessage& message);
    void save(const ViewMessage& message);
    void give_up(const ViewMessage& message);
    void fail(std::int64_t number, const std::string& what);
    void greet();

    ViewedScene& scene_;
    Send send_;
    std::optional<ViewDrawer> drawer_;  // of the thread

    std::mutex mutex_;  // guards what follows
    std::condition_variable wakes_;
    std::optional<ViewMessage> newest_look_, newest_draw_;
    std::deque<ViewMessage> requests_;
    bool draws_full_ = false;
    bool is_stopped_ = false;

    StopFlag stops_drawing_{false};
    std::atomic<bool> is_done_{false};
    std::thread thread_;
};

}  // namespace burin
