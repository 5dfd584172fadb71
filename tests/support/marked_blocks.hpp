/// The parts of a document that a test carries out: fenced blocks behind a mark, `<!-- tested: MARK -->`.
#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace lockstep::test {

struct Block {
  std::string mark;
  std::string text;  ///< lines with their ends
};

inline std::vector<Block> marked_blocks(const std::string& document) {
  std::vector<Block> blocks;
  std::istringstream lines(document);
  const std::string begin = "<!-- tested: ";
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(begin, 0) != 0) continue;
    Block block{line.substr(begin.size(), line.find(" -->") - begin.size()), ""};
    std::getline(lines, line);
    EXPECT_EQ(line.rfind("```", 0), 0u) << "no block after the mark " << block.mark;
    while (std::getline(lines, line) && line != "```") block.text += line + "\n";
    blocks.push_back(block);
  }
  return blocks;
}

}  // namespace lockstep::test
