// Tokens, blocks and the layout of a program.
#include "projects/aposs/parser.hpp"

#include <algorithm>

#include "projects/json/problem.hpp"

namespace lockstep::aposs {
namespace {

constexpr std::size_t kDeepestBlock = 64;

}  // namespace

Parser::Parser(std::span<const Token> tokens, Messages& messages, bool later_edition,
               const std::vector<std::string>& first_variables)
    : tokens_(tokens), messages_(messages), later_edition_(later_edition), assigned_(assigned_names(tokens)) {
  for (const std::string& name : first_variables) emitter_.reserve_variable(folded(name), name);
}

const Token& Parser::peek(std::size_t ahead) const {
  return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
}

const Token& Parser::take() {
  const Token& token = peek();
  if (at_ + 1 < tokens_.size()) ++at_;
  return token;
}

bool Parser::at_symbol(std::string_view symbol, std::size_t ahead) const {
  return peek(ahead).kind == Token::Kind::kSymbol && peek(ahead).text == symbol;
}

bool Parser::at_word(std::string_view word, std::size_t ahead) const {
  return peek(ahead).kind == Token::Kind::kName && peek(ahead).folded == word;
}

bool Parser::accept_symbol(std::string_view symbol) {
  if (!at_symbol(symbol)) return false;
  take();
  return true;
}

bool Parser::accept_word(std::string_view word) {
  if (!at_word(word)) return false;
  take();
  return true;
}

void Parser::expect_symbol(std::string_view symbol, std::string_view where) {
  if (!accept_symbol(symbol)) fail_here("'" + std::string(symbol) + "' " + std::string(where));
}

void Parser::expect_word(std::string_view word, std::string_view where) {
  if (!accept_word(word)) fail_here(std::string(word) + " " + std::string(where));
}

bool Parser::on_same_line() const {
  if (at_ == 0 || peek().kind == Token::Kind::kEnd) return false;
  const Place &before = tokens_[at_ - 1].place, &here = peek().place;
  return before.line == here.line && before.file == here.file;
}

std::string Parser::shown() const {
  return peek().kind == Token::Kind::kEnd ? peek().text : quote(peek().text);
}

void Parser::fail(const Place& place, std::string text) {
  messages_.error(place, std::move(text));
  throw Unreadable{};
}

void Parser::fail_here(std::string_view allowed) {
  fail(peek().place, shown() + " cannot stand here; allowed: " + std::string(allowed));
}

void Parser::skip_line(const Place& place) {
  while (peek().kind != Token::Kind::kEnd && peek().place.file == place.file &&
         peek().place.line == place.line)
    take();
}

void Parser::program() {
  statements();
  while (peek().kind != Token::Kind::kEnd) {  // a closing word that nothing has taken
    take();
    statements();
  }
  emitter_.emit(peek().place, Operation::kEnd);
  resolve();
  look_at_reads();
}

// What block a word at this place closes, if it is one that does.
std::optional<Parser::Block> Parser::closes() const {
  if (at_symbol("}")) return Block::kBrace;
  if (peek().kind != Token::Kind::kName) return std::nullopt;
  static const std::map<std::string_view, Block> kClosers = {
      {"ENDIF", Block::kIf},       {"ELSE", Block::kIf},      {"ELSEIF", Block::kIf},
      {"ENDWHILE", Block::kWhile}, {"UNTIL", Block::kRepeat}, {"RETURN", Block::kSubprogram},
      {"ENDPROG", Block::kArea}};
  const auto closer = kClosers.find(peek().folded);
  if (closer != kClosers.end()) return closer->second;
  if (peek().folded == "SUBPROG") return Block::kSubprogram;
  if (peek().folded == "SUBMAINPROG") return Block::kArea;
  return std::nullopt;
}

void Parser::stray(Block kind) {
  const Place place = peek().place;
  const std::string word = peek().text;
  std::string text = folded(word) + " without ";
  switch (kind) {
    case Block::kIf:
      text += "IF";
      if (last_if_ != 0)
        text +=
            "; the IF of line " + std::to_string(last_if_) + " ended in line " + std::to_string(last_endif_);
      break;
    case Block::kWhile:
      text += "WHILE";
      break;
    case Block::kRepeat:
      text += "REPEAT";
      break;
    case Block::kBrace:
      text = "'}' without '{'";
      break;
    case Block::kSubprogram:
      text += "SUBPROG";
      break;
    case Block::kArea:
      text += "SUBMAINPROG";
      break;
  }
  messages_.error(place, text);
  skip_line(place);
}

// Whether another RETURN follows before the next subprogram: then this one stands within a block.
bool Parser::returns_again() const {
  for (std::size_t i = at_ + 1; i < tokens_.size(); ++i) {
    if (tokens_[i].kind != Token::Kind::kName) continue;
    if (tokens_[i].folded == "RETURN") return true;
    if (tokens_[i].folded == "SUBPROG" || tokens_[i].folded == "ENDPROG") return false;
  }
  return false;
}

// Statements up to a word that closes an open block, or to the end of the text.
void Parser::statements() {
  while (peek().kind != Token::Kind::kEnd) {
    if (const auto kind = closes()) {
      const auto is_open = [&](Block block) {
        return std::any_of(open_.begin(), open_.end(),
                           [block](const OpenBlock& one) { return one.kind == block; });
      };
      const bool begins_area = at_word("SUBMAINPROG");
      const bool begins_subprogram = at_word("SUBPROG");
      if (at_word("RETURN") && is_open(Block::kSubprogram) && open_.back().kind != Block::kSubprogram &&
          returns_again()) {
        messages_.error(
            peek().place,
            "RETURN within a block; allowed: one RETURN, at the end of the SUBPROG (a GOTO may lead to a "
            "label before it)");
        take();
        continue;
      }
      if (is_open(*kind)) return;
      if (begins_area && open_.empty()) {
        subprogram_area();
        continue;
      }
      if (begins_area) return;
      if (begins_subprogram) {
        if (is_open(Block::kArea)) return;
        area_without_subprogram();
        continue;
      }
      stray(*kind);
      continue;
    }
    statement();
  }
}

void Parser::area_without_subprogram() {
  messages_.error(peek().place, "SUBPROG outside of SUBMAINPROG and ENDPROG; allowed: between them");
  const std::uint32_t jump = emitter_.emit(peek().place, Operation::kJump);
  open_.push_back({Block::kArea, peek().place.line});
  subprogram();
  open_.pop_back();
  emitter_.land(jump);
}

void Parser::statement() {
  const Token& first = peek();
  const std::uint32_t mark = emitter_.mark();
  const std::size_t blocks = open_.size();
  nested_ = operators_ = 0;
  try {
    const bool is_name = first.kind == Token::Kind::kName;
    if (!at_word("DIM")) dim_is_over_ = true;
    if (is_name && at_symbol(":", 1)) {
      label();
    } else if (at_word("IF")) {
      if_statement();
    } else if (at_word("WHILE")) {
      while_statement();
    } else if (at_word("REPEAT")) {
      repeat_statement();
    } else if (at_word("ON")) {
      on_statement();
    } else if (const auto named = command_at(tokens_.subspan(at_))) {
      command_statement(*named, first);
    } else if (is_name) {
      assignment();
    } else {
      fail(first.place, shown() + " cannot begin a statement; allowed: a command, a label, a variable");
    }
  } catch (const Unreadable&) {
    open_.resize(std::min(open_.size(), blocks));
    // What has been read of it may end on a further line; the line behind that is another's.
    const Place& last = tokens_[at_ > 0 ? at_ - 1 : 0].place;
    skip_line(last);
    skip_line(first.place);
  }
  emitter_.release(mark);
}

void Parser::missing_end(const char* begin, const char* end, std::uint32_t line) {
  messages_.error(peek().place, std::string(begin) + " of line " + std::to_string(line) + " has no " + end +
                                    " before " + shown());
}

// One that cannot be read is told; what the block holds is looked at all the same.
ExpressionPointer Parser::condition_of(std::string_view block, std::string_view end) {
  const Place place = peek().place;
  try {
    ExpressionPointer condition = expression();
    expect_word(end, "behind the condition of " + std::string(block));
    return condition;
  } catch (const Unreadable&) {
    nested_ = 0;
    skip_line(peek().place);
    return constant(place, 0);
  }
}

void Parser::if_statement() {
  const std::uint32_t line = take().place.line;
  if (open_.size() >= kDeepestBlock) fail(peek().place, "blocks are nested too deep; allowed: 64");
  open_.push_back({Block::kIf, line});
  std::vector<std::uint32_t> ends;
  bool has_else = false;
  for (bool again = true; again;) {
    const Place place = peek().place;
    const std::uint32_t mark = emitter_.mark();
    const ExpressionPointer condition = condition_of("IF", "THEN");
    const std::uint32_t past =
        emitter_.emit(place, Operation::kJumpIfZero, std::uint32_t{0}, value(*condition));
    emitter_.release(mark);
    statements();
    again = false;
    if (at_word("ELSEIF") || at_word("ELSE")) {
      ends.push_back(emitter_.emit(peek().place, Operation::kJump));
      emitter_.land(past);
      if (accept_word("ELSEIF")) {
        again = true;
        continue;
      }
      take();
      has_else = true;
      statements();
    } else {
      emitter_.land(past);
    }
  }
  while (has_else && (at_word("ELSE") || at_word("ELSEIF"))) {
    messages_.error(peek().place, peek().folded + " behind ELSE; allowed: ENDIF");
    skip_line(peek().place);
    statements();
  }
  open_.pop_back();
  if (at_word("ENDIF")) {
    last_if_ = line;
    last_endif_ = take().place.line;
  } else {
    missing_end("IF", "ENDIF", line);
  }
  for (const std::uint32_t jump : ends) emitter_.land(jump);
}

void Parser::while_statement() {
  const std::uint32_t line = take().place.line;
  if (open_.size() >= kDeepestBlock) fail(peek().place, "blocks are nested too deep; allowed: 64");
  open_.push_back({Block::kWhile, line});
  const std::uint32_t begin = emitter_.next();
  const Place place = peek().place;
  const std::uint32_t mark = emitter_.mark();
  const ExpressionPointer condition = condition_of("WHILE", "DO");
  const std::uint32_t past =
      emitter_.emit(place, Operation::kJumpIfZero, std::uint32_t{0}, value(*condition));
  emitter_.release(mark);
  if (at_symbol("{")) {
    messages_.warn(peek().place,
                   "braces around the body of WHILE do nothing; the usual form is WHILE … DO … ENDWHILE");
    const std::uint32_t brace = take().place.line;
    open_.push_back({Block::kBrace, brace});
    statements();
    open_.pop_back();
    if (!accept_symbol("}")) missing_end("'{'", "'}'", brace);
  }
  statements();
  open_.pop_back();
  const std::uint32_t back = emitter_.emit(peek().place, Operation::kJump);
  emitter_.aim(back, begin);
  emitter_.land(past);
  if (!accept_word("ENDWHILE")) missing_end("WHILE", "ENDWHILE", line);
}

void Parser::repeat_statement() {
  const std::uint32_t line = take().place.line;
  if (open_.size() >= kDeepestBlock) fail(peek().place, "blocks are nested too deep; allowed: 64");
  open_.push_back({Block::kRepeat, line});
  const std::uint32_t begin = emitter_.next();
  statements();
  open_.pop_back();
  const Place place = peek().place;
  if (!accept_word("UNTIL")) return missing_end("REPEAT", "UNTIL", line);
  const ExpressionPointer condition = expression();
  const std::uint32_t back =
      emitter_.emit(place, Operation::kJumpIfZero, std::uint32_t{0}, value(*condition));
  emitter_.aim(back, begin);
}

void Parser::subprogram_area() {
  const Token& begin = take();
  if (has_area_) messages_.error(begin.place, "a second SUBMAINPROG; allowed: one in a program");
  has_area_ = true;
  const std::uint32_t jump = emitter_.emit(begin.place, Operation::kJump);
  open_.push_back({Block::kArea, begin.place.line});
  while (peek().kind != Token::Kind::kEnd && !at_word("ENDPROG")) {
    if (at_word("SUBPROG")) {
      subprogram();
      continue;
    }
    const Place place = peek().place;
    messages_.error(place, shown() + " between SUBMAINPROG and ENDPROG; allowed here: SUBPROG, ENDPROG");
    skip_line(place);
    while (peek().kind != Token::Kind::kEnd && !at_word("SUBPROG") && !at_word("ENDPROG")) take();
  }
  open_.pop_back();
  if (!accept_word("ENDPROG"))
    messages_.warn(peek().place, "ENDPROG is missing at the end of the file; SUBMAINPROG stands in line " +
                                     std::to_string(begin.place.line));
  emitter_.land(jump);
}

void Parser::subprogram() {
  const std::uint32_t line = take().place.line;
  const Token& name = peek();
  routine_ = routines_.size() + 1;
  std::string folded_name;
  if (name.kind == Token::Kind::kName && on_same_line()) {
    take();
    folded_name = name.folded;
    const auto [known, fresh] =
        subprograms_.try_emplace(folded_name, Label{emitter_.next(), routine_, name.place});
    if (!fresh)
      messages_.error(name.place, "a second SUBPROG " + quote(name.text) + "; the first stands in line " +
                                      std::to_string(known->second.place.line));
  } else {
    messages_.error(name.place, "SUBPROG: the name of the subprogram is missing");
  }
  routines_.push_back({name.text, static_cast<std::uint16_t>(emitter_.next())});
  open_.push_back({Block::kSubprogram, line});
  statements();
  open_.pop_back();
  const Place end = peek().place;
  if (!accept_word("RETURN")) missing_end("SUBPROG", "RETURN", line);
  emitter_.emit(end, Operation::kReturn);
  routine_ = 0;
}

void Parser::label() {
  const Token& name = take();
  take();
  if (is_no_label(name.folded))
    return messages_.error(name.place, quote(name.text) + " is a word of the language and no label");
  if (assigned_.contains(name.folded) || array_numbers_.contains(name.folded))
    return messages_.error(name.place,
                           quote(name.text) + " is a variable and a label; allowed: one of the two");
  const auto [known, fresh] = labels_.try_emplace(name.folded, Label{emitter_.next(), routine_, name.place});
  if (!fresh)
    messages_.error(name.place, "a second label " + quote(name.text) + "; the first stands in line " +
                                    std::to_string(known->second.place.line));
}

// Jumps to labels and calls of subprograms, when all are known.
void Parser::resolve() {
  const auto names = [](const std::map<std::string, Label>& all) {
    std::vector<std::string_view> result;
    for (const auto& [name, label] : all) result.push_back(name);
    return result;
  };
  for (const Reference& jump : jumps_) {
    const auto label = labels_.find(jump.name);
    if (label == labels_.end()) {
      messages_.error(jump.place, "there is no label " + quote(jump.written + ":") +
                                      did_you_mean(jump.name, names(labels_)));
      continue;
    }
    if (label->second.routine != jump.routine)
      messages_.warn(
          jump.place,
          "the jump to " + quote(jump.written) +
              " leads out of a subprogram or into one; a RETURN behind it has no GOSUB: error 152");
    if (jump.routine != 0 && label->second.routine != jump.routine)
      emitter_.leave(jump.instruction, label->second.routine == 0);
    emitter_.aim(jump.instruction, label->second.instruction);
  }
  for (const Reference& call : calls_) {
    const auto subprogram = subprograms_.find(call.name);
    if (subprogram == subprograms_.end())
      messages_.error(call.place, "there is no SUBPROG " + quote(call.written) +
                                      did_you_mean(call.name, names(subprograms_)));
    else
      emitter_.aim(call.instruction, subprogram->second.instruction);
  }
}

void Parser::look_at_reads() {
  std::set<std::string> told;
  for (const Read& read : reads_)
    if (!assigned_.contains(read.name) && told.insert(read.name).second)
      messages_.warn(read.place, quote(read.written) + " is read and never assigned: it is 0" +
                                     nearest_name(read.name, assigned_));
}

Image Parser::finish(std::size_t maximum_variables) {
  Image image = emitter_.finish(messages_, arrays_.size(), maximum_variables);
  image.arrays = std::move(arrays_);
  image.routines = std::move(routines_);
  return image;
}

}  // namespace lockstep::aposs
