// The part of Recorder that says where a run stands, and goes on from there.
#include <algorithm>

#include "slipscale/base/parallel.hpp"
#include "slipscale/files/disk_space.hpp"
#include "slipscale/record/recorder.hpp"

namespace slipscale {

/// What the steps before the restart left, from the checkpoint and from the rows of history.h5.
void Recorder::go_on(const Restart& restart) {
  std::vector<StateGroup> groups;
  if (statistics_) groups = statistics_->state();
  const bool recorded = keeps_force_;
  if (recorded) groups.push_back(force_.state(restart.steps_done() - 1));
  if (interfaces_)
    for (StateGroup& group : interfaces_->state()) groups.push_back(std::move(group));
  restart.read(groups);
  if (interfaces_) interfaces_->resume();
  if (statistics_) statistics_->resume();
  if (recorded) force_.resume();
  last_sound_ = static_cast<long>(position_.last_sound);
  last_frame_ = static_cast<long>(position_.last_frame);
  largest_residual_ = position_.largest_residual;
  rounded_residual_ = position_.rounded_residual;
  if (history_) rows_ = history_->rows_so_far();
  if (position_.history_every != static_cast<double>(history_every_))
    position_.even_from = position_.history_rows;
  if (interfaces_file_) interfaces_file_->recall();
  std::string refusal;
  for (const SeriesFile* series : all_series())
    if (refusal.empty()) refusal = series->refusal();
  throw_together(body_.comm(), refusal);
  check_contents(restart);
}

/// Whether the files still hold what the run wrote into them.
void Recorder::check_contents(const Restart& restart) {
  const bool root = is_root(body_.comm()), frames = fields_ && position_.frames > 0;
  std::vector<StateGroup> groups{history_marks_.state(history_ ? history_->series().quantities() : 0, root)};
  if (has_contact_)
    groups.push_back(contact_marks_.state(contact_ ? contact_->series().quantities() : 0, root));
  if (interfaces_)
    groups.push_back(
        interfaces_marks_.state(interfaces_file_ ? interfaces_file_->series().quantities() : 0, root));
  if (frames) groups.push_back(fields_marks_.state(root ? fields_->contents().size() : 0, root));
  restart.read(groups);
  std::string refusal;
  if (history_) {
    history_->series().expect(history_marks_.contents());
    refusal = history_->series().refusal();
  }
  if (contact_ && refusal.empty()) {
    contact_->series().expect(contact_marks_.contents());
    refusal = contact_->series().refusal();
  }
  if (interfaces_file_ && refusal.empty()) {
    interfaces_file_->series().expect(interfaces_marks_.contents());
    refusal = interfaces_file_->series().refusal();
  }
  throw_together(body_.comm(), refusal);
  if (frames) fields_->expect(fields_marks_.contents());
}

std::vector<StateGroup> Recorder::state(long n) {
  const auto on_cadence = [&](double rows, long every) {
    return rows - (n == last_ && n % every != 0 ? 1 : 0);
  };
  RunPosition& at = position_;
  at.set_time_step(time_);
  at.history_every = static_cast<double>(history_every_);
  at.contact_every = has_contact_ ? static_cast<double>(contact_every_) : 0;
  at.contact_auto = has_contact_ && !choice_.contact.given() ? 1 : 0;
  at.interfaces_every = interfaces_ ? static_cast<double>(interfaces_every_) : 0;
  at.interfaces_auto = interfaces_ && !choice_.interface_rows.given() ? 1 : 0;
  at.fields_every = fields_every_ ? static_cast<double>(*fields_every_) : 0;
  if (window_) {
    at.window_first = static_cast<double>(window_->first);
    at.window_last = static_cast<double>(window_->last);
    at.window_every = static_cast<double>(window_->every);
  }
  // The last row of a run may lie between the others; a run that goes further has no row there.
  if (history_) at.history_rows = on_cadence(static_cast<double>(history_->series().rows()), history_every_);
  if (contact_) at.contact_rows = on_cadence(static_cast<double>(contact_->series().rows()), contact_every_);
  if (interfaces_file_)
    at.interface_rows = on_cadence(static_cast<double>(interfaces_file_->series().rows()), interfaces_every_);
  if (fields_) {
    at.frames = static_cast<double>(fields_->frames());
    if (fields_every_) at.frames = on_cadence(at.frames, *fields_every_);
  }
  at.last_sound = static_cast<double>(last_sound_);
  at.last_frame = static_cast<double>(last_frame_);
  at.largest_residual = largest_residual_;
  at.rounded_residual = rounded_residual_;
  at.force_kept = keeps_force_ ? 1 : 0;
  RunPosition written = at;
  written.seconds = seconds();
  written_ = written;
  const bool root = is_root(body_.comm());
  const auto contents = [](const auto& file, double rows) {
    return file ? file->series().contents(static_cast<hsize_t>(rows)) : std::vector<std::uint64_t>{};
  };
  std::vector<StateGroup> groups{written_.state(root),
                                 history_marks_.state(contents(history_, at.history_rows), root)};
  if (has_contact_) groups.push_back(contact_marks_.state(contents(contact_, at.contact_rows), root));
  if (interfaces_) {
    groups.push_back(interfaces_marks_.state(contents(interfaces_file_, at.interface_rows), root));
    for (StateGroup& group : interfaces_->state()) groups.push_back(std::move(group));
  }
  if (fields_) {
    std::vector<std::uint64_t> frames = fields_->contents();
    frames.resize(std::min(frames.size(), 1 + static_cast<std::size_t>(at.frames)));
    groups.push_back(fields_marks_.state(frames, root));
  }
  if (statistics_)
    for (StateGroup& group : statistics_->state()) groups.push_back(std::move(group));
  if (keeps_force_) groups.push_back(force_.state(n));
  return groups;
}

void Recorder::sync() {
  for (SeriesFile* series : all_series()) series->flush();
  share_faults();
  write_together(body_.comm(), folder_.path(), [&] {
    if (history_) sync_file(folder_.path("history.h5"));
    if (contact_) sync_file(folder_.path("contact.h5"));
    if (interfaces_file_) sync_file(folder_.path("interfaces.h5"));
    if (history_ && fields_) sync_file(folder_.path("fields.h5"));
  });
}

double Recorder::seconds() const {
  return position_.seconds + std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

}  // namespace slipscale
