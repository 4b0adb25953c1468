// Reads the output of child processes line by line on its own thread, so that no child blocks on a
// full pipe.
//
// Bounded  a line has at most 20 KiB; a longer line is split.
// Threads  Add() and the destructor from one thread; the callbacks run on the reader's thread.
#pragma once

#include <sys/types.h>

#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "gsv/base/mutex.h"

namespace gsv::app {

class ChildProcess;

class OutputReader {
 public:
  // kOutput: stdout; kErrors: stderr.
  enum class Stream { kOutput, kErrors };
  struct Callbacks {
    std::function<void(pid_t pid, Stream stream, const std::string& line)> on_line;
    // Called after the last line. `ending` is "exit code 1" or "signal 11".
    std::function<void(pid_t pid, const std::string& ending)> on_end;
    // Called every 0.2 s, and after each burst of lines.
    std::function<void()> on_pause;
  };

  explicit OutputReader(Callbacks callbacks);
  ~OutputReader();
  OutputReader(const OutputReader&) = delete;
  OutputReader& operator=(const OutputReader&) = delete;

  // Starts to read the child's stderr. The child must have been started by StartCaptured(). It must
  // outlive this object.
  void AddErrors(const ChildProcess& child);
  // Starts to read the child's stdout too. From then on, the caller must not read the stdout.
  void AddOutput(ChildProcess& child);
  // Waits until all output so far was read, for at most half a second.
  void WaitForOutput();

 private:
  // One stream of a child.
  struct Source {
    pid_t pid = 0;
    int descriptor = -1;  // -1: closed
    Stream stream = Stream::kErrors;
    std::string partial;  // the line that has not ended yet
  };
  // A process whose output is read.
  struct Child {
    int pid_descriptor = -1;  // becomes readable when the process ends
    bool has_ended = false;
  };

  void Run();  // the function of the reader's thread
  // Returns false if the stream has ended.
  bool Read(Source& source);
  // Reads the output that is left in the pipe after the child has ended.
  void ReadRest(Source& source);
  // Calls on_line.
  void Emit(const Source& source, const std::string& line);
  // Calls on_end, and removes the child.
  void EndChild(pid_t pid);
  // Wakes the reader's thread from poll().
  void Wake();

  const Callbacks callbacks_;
  int wake_ends_[2] = {-1, -1};  // both ends of the pipe of Wake()
  base::Mutex mutex_;
  // Streams and children that the reader's thread has not yet taken over.
  std::vector<Source> added_ GSV_GUARDED_BY(mutex_);
  std::map<pid_t, int> added_children_ GSV_GUARDED_BY(mutex_);  // their pid descriptors
  bool is_stopping_ GSV_GUARDED_BY(mutex_) = false;
  // Whether a thread is in WaitForOutput().
  bool has_waiter_ GSV_GUARDED_BY(mutex_) = false;
  base::ConditionVariable all_read_;  // notified when all output so far was read
  // used by the reader's thread only
  std::vector<Source> sources_;  // the streams that are open
  std::map<pid_t, Child> children_;
  std::jthread thread_;  // the reader's thread: it executes Run()
};

}  // namespace gsv::app
