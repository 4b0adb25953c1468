#include "apps/gsv/process/problem_report.h"

#include <map>
#include <set>

namespace gsv::app {

std::vector<std::string> GroupedSentences(const base::Problems& problems,
                                          base::Problem::Severity severity) {
  std::vector<const base::Problem*> firsts;
  std::map<std::string, std::set<std::string>> places;
  for (const base::Problem& problem : problems) {
    if (problem.severity != severity) continue;
    auto& of_message = places[problem.message];
    if (of_message.empty()) firsts.push_back(&problem);
    of_message.insert(problem.where);
  }
  std::vector<std::string> sentences;
  for (const base::Problem* first : firsts) {
    const std::size_t more = places[first->message].size() - 1;
    std::string sentence = first->Sentence();
    if (more > 0) {
      sentence +=
          " (and in " + std::to_string(more) + (more == 1 ? " more place)" : " more places)");
    }
    sentences.push_back(std::move(sentence));
  }
  return sentences;
}

std::vector<std::string> Shortened(std::vector<std::string> sentences, std::size_t count,
                                   const std::string& how_to_see_all) {
  if (sentences.size() <= count + 1) return sentences;
  const std::size_t rest = sentences.size() - count;
  sentences.resize(count);
  sentences.push_back(std::to_string(rest) + " more warnings; " + how_to_see_all);
  return sentences;
}

}  // namespace gsv::app
