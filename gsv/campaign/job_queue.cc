#include "gsv/campaign/job_queue.h"

#include "gsv/campaign/commands.h"

namespace gsv::campaign {

std::string TaskCommand::Text() const {
  return "exec " + Quoted(program) + " campaign task " + Quoted(batch_file) + " --task " + task +
         " --job " + job + " --node " + node + " --jobs " + jobs + (more.empty() ? "" : " " + more);
}

}  // namespace gsv::campaign
