// Notes that viewers attach to instants of a run.
//
// A note is an event of the simulation, of the kind kNoteEvent, whose detail has the instant and
// the text. A note is published and recorded on /gsv/notes, apart from the other events, because a
// note is not part of the run.
#pragma once

#include <string>
#include <string_view>

#include "gsv/messages/gsv_msgs.h"
#include "gsv/simulation/types.h"

namespace gsv::presentation {

inline constexpr std::string_view kNoteEvent = "note";

inline bool IsNote(const simulation::Event& event) { return event.kind == kNoteEvent; }

// Returns the detail of a note on the instant `time`: "at 12.5 s: TEXT".
std::string NoteDetail(base::SimTime time, std::string_view text);

// Returns the instant of the note: the one in NoteDetail(), or else the time of the event.
base::SimTime TimeOfNote(const simulation::Event& event);

// Returns the note as a message. Its stamp is TimeOfNote(). Its detail is the text without the
// beginning that NoteDetail() has added.
messages::gsv_msgs::LifecycleEvent NoteMessage(const simulation::Event& event);

}  // namespace gsv::presentation
