#include "web/view_session.h"

#include <new>
#include <utility>

#include "base/error.h"
#include "web/view_answers.h"

namespace burin {
namespace {

constexpr std::size_t kMostRequests = 16;  // that wait

}  // namespace

ViewSession::ViewSession(ViewedScene& scene, Send send)
    : scene_(scene), send_(std::move(send)), thread_([this] { work(); }) {}

ViewSession::~ViewSession() {
    stop();
    thread_.join();
}

void ViewSession::stop() {
    const std::lock_guard lock(mutex_);
    is_stopped_ = true;
    stops_drawing_.store(true);
    wakes_.notify_one();
}

void ViewSession::receive(std::string_view text) {
    ViewMessage message;
    try {
        message = read_view_message(text);
    } catch (const InputError& error) {
        return fail(0, error.what());
    }
    const std::lock_guard lock(mutex_);
    using Kind = ViewMessage::Kind;
    if (message.kind == Kind::draw) {
        newest_draw_ = std::move(message);
    } else if (message.kind == Kind::look) {
        newest_look_ = std::move(message);
    } else if (requests_.size() < kMostRequests) {
        requests_.push_back(std::move(message));
    } else {
        return fail(message.number, "too much is asked for at once");
    }
    if (draws_full_) stops_drawing_.store(true);
    wakes_.notify_one();
}

std::optional<ViewMessage> ViewSession::next_message() {
    std::unique_lock lock(mutex_);
    draws_full_ = false;
    wakes_.wait(lock, [&] { return is_stopped_ || newest_look_ || newest_draw_ || !requests_.empty(); });
    if (is_stopped_) return std::nullopt;
    stops_drawing_.store(false);
    if (newest_look_) return std::exchange(newest_look_, std::nullopt);
    // A picture in full quality waits, for it is given up when anything else is asked for.
    if (newest_draw_ && (!newest_draw_->is_full || requests_.empty())) {
        draws_full_ = newest_draw_->is_full;
        return std::exchange(newest_draw_, std::nullopt);
    }
    ViewMessage request = std::move(requests_.front());
    requests_.pop_front();
    return request;
}

void ViewSession::work() {
    const StopScope scope(stops_drawing_);
    try {
        drawer_.emplace(scene_);
        greet();
        while (const auto message = next_message()) answer(*message);
    } catch (const Interrupted&) {  // it was stopped while it began
    } catch (const std::exception& error) {
        fail(0, error.what());
    }
    drawer_.reset();
    is_done_.store(true);
}

void ViewSession::answer(const ViewMessage& message) {
    using Kind = ViewMessage::Kind;
    try {
        switch (message.kind) {
            case Kind::draw:
                return draw(message);
            case Kind::look:
                return look(message);
            case Kind::home:
                return send_({view_answer(message.number, scene_.home(message.view.width, message.view.height)), true});
            case Kind::fit:
                return send_({view_answer(message.number, scene_.fitted(message.view)), true});
            case Kind::explain:
                return explain(message);
            case Kind::save:
                return save(message);
            case Kind::command:
                return send_({command_answer(message.number, scene_.tables().command(drawer_->look(), message.view),
                                             scene_.name()),
                              true});
        }
    } catch (const Interrupted&) {
        if (message.kind == Kind::draw) return give_up(message);
    } catch (const std::bad_alloc&) {
        fail(message.number, "out of memory; make the window smaller");
    } catch (const std::exception& error) {
        fail(message.number, error.what());
    }
}

/// A picture in full quality that was given up for a request, and not for another view, is due again.
void ViewSession::give_up(const ViewMessage& message) {
    const std::lock_guard lock(mutex_);
    if (!newest_draw_ && !newest_look_ && !is_stopped_) newest_draw_ = message;
}

void ViewSession::draw(const ViewMessage& message) {
    const DrawnView drawn = drawer_->draw(message.view, message.is_full);
    send_({frame_answer(message, drawn), false});
}

void ViewSession::look(const ViewMessage& message) {
    drawer_->set_look(message.look);
    send_({look_answer(message.number, drawer_->sheet()), true});
}

void ViewSession::explain(const ViewMessage& message) {
    const ExplainedPixel pixel = drawer_->explain(message.view, message.x, message.y, message.reach_px);
    send_({explain_answer(message.number, pixel), true});
}

void ViewSession::save(const ViewMessage& message) {
    std::vector<std::string> notes;
    std::string file;
    switch (message.format) {
        case ViewMessage::Format::png:
            file = drawer_->png(message.view);
            break;
        case ViewMessage::Format::svg:
            file = drawer_->svg(message.view, notes);
            break;
        case ViewMessage::Format::toml:
            file = scene_.tables().scene_text(drawer_->look(), message.view);
            break;
    }
    send_({file_answer(message, scene_.name(), notes, file), false});
}

void ViewSession::fail(std::int64_t number, const std::string& what) { send_({error_answer(number, what), true}); }

void ViewSession::greet() { send_({hello_answer(scene_, drawer_->look(), drawer_->sheet()), true}); }

}  // namespace burin
