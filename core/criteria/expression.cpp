#include "core/criteria/expression.hpp"

#include <algorithm>
#include <utility>

#include "core/criteria/parser.hpp"
#include "core/fault/fault.hpp"

namespace breach::criteria {

namespace {

using Code = Instruction::Code;

constexpr std::size_t longest_text = 4096;
constexpr int deepest_nesting = 64;

/// Recursive descent: or, and, not, comparison, sum, product, factor. Each level returns the kind
/// of value that it left on the stack.
class Parsing {
  public:
    Parsing(std::string_view text, const std::vector<std::string>& known)
        : known_(known), words_(words_of(text)) {
        made_.text = text;
    }

    Expression whole(Kind wanted) {
        const std::size_t begin = word().column;
        made_.kind = disjunction();
        if (word().kind != Word::Kind::end)
            complain("'" + word().text + "' was not expected", "join conditions with and / or");
        need(made_.kind, wanted, begin);
        return std::move(made_);
    }

  private:
    const Word& word() const { return words_[at_]; }
    bool take(std::string_view text) {
        if (word().kind == Word::Kind::end || word().text != text) return false;
        ++at_;
        return true;
    }
    [[noreturn]] void complain(const std::string& cause, const std::string& remedy) const {
        throw Complaint{word().column, cause, remedy};
    }
    void expect(std::string_view text) {
        if (!take(text))
            complain("'" + std::string(text) + "' was expected, not '" + word().text + "'",
                     "close what was opened");
    }
    static void need(Kind found, Kind wanted, std::size_t column) {
        if (found == wanted) return;
        if (wanted == Kind::condition)
            throw Complaint{column, "this is a number, but a condition is needed",
                            "compare it with something: x < 0.97"};
        throw Complaint{column, "this is a condition, but a number is needed",
                        "join conditions with and / or, not with + - * / or a second comparison"};
    }
    void emit(Instruction instruction, int change_of_height) {
        made_.program.push_back(instruction);
        height_ += static_cast<std::size_t>(change_of_height);
        made_.depth = std::max(made_.depth, height_);
    }

    Kind disjunction() {
        const std::size_t begin = word().column;
        Kind kind = conjunction();
        while (word().text == "or") kind = joined(kind, begin, Code::either);
        return kind;
    }
    Kind conjunction() {
        const std::size_t begin = word().column;
        Kind kind = negation();
        while (word().text == "and") kind = joined(kind, begin, Code::both);
        return kind;
    }
    Kind joined(Kind left, std::size_t begin, Code code) {
        need(left, Kind::condition, begin);
        ++at_;
        const std::size_t right = word().column;
        need(code == Code::either ? conjunction() : negation(), Kind::condition, right);
        emit({code}, -1);
        return Kind::condition;
    }
    Kind negation() {
        if (!take("not")) return comparison();
        const Nesting nesting(*this);
        const std::size_t begin = word().column;
        need(negation(), Kind::condition, begin);
        emit({Code::opposite}, 0);
        return Kind::condition;
    }
    Kind comparison() {
        const std::size_t begin = word().column;
        const Kind left = sum();
        constexpr Sign signs[] = {{"<=", Code::less_equal},
                                  {">=", Code::greater_equal},
                                  {"<", Code::less},
                                  {">", Code::greater}};
        for (const auto& [sign, code] : signs) {
            if (!take(sign)) continue;
            need(left, Kind::quantity, begin);
            const std::size_t right = word().column;
            need(sum(), Kind::quantity, right);
            emit({code}, -1);
            return Kind::condition;
        }
        return left;
    }
    Kind sum() { return chain(&Parsing::product, {"+", Code::add}, {"-", Code::subtract}); }
    Kind product() { return chain(&Parsing::factor, {"*", Code::multiply}, {"/", Code::divide}); }
    using Sign = std::pair<std::string_view, Code>;
    Kind chain(Kind (Parsing::*operand)(), const Sign& one, const Sign& other) {
        const std::size_t begin = word().column;
        Kind kind = (this->*operand)();
        while (word().text == one.first || word().text == other.first) {
            const Code code = word().text == one.first ? one.second : other.second;
            need(kind, Kind::quantity, begin);
            ++at_;
            const std::size_t right = word().column;
            need((this->*operand)(), Kind::quantity, right);
            emit({code}, -1);
        }
        return kind;
    }
    Kind factor() {
        const Nesting nesting(*this);
        if (take("(")) {
            const Kind kind = disjunction();
            expect(")");
            return kind;
        }
        if (take("-")) {
            const std::size_t begin = word().column;
            need(factor(), Kind::quantity, begin);
            emit({Code::negate}, 0);
            return Kind::quantity;
        }
        if (word().kind == Word::Kind::number) {
            emit({Code::constant, word().value}, 1);
            ++at_;
            return Kind::quantity;
        }
        if (word().kind != Word::Kind::name || is_reserved(word().text))
            complain("a number or a telemetry field was expected, not '" + word().text + "'",
                     "write for example: jacobian_least_avg < 0.97");
        return words_[at_ + 1].text == "(" ? call() : field();
    }
    static bool is_reserved(const std::string& name) {
        return name == "and" || name == "or" || name == "not";
    }
    Kind field() {
        const std::string& name = word().text;
        if (!known_.empty() && std::ranges::find(known_, name) == known_.end()) {
            std::string list;
            for (const std::string& each : known_) list += (list.empty() ? "" : ", ") + each;
            complain("there is no telemetry field '" + name + "'", "known fields: " + list);
        }
        auto found = std::ranges::find(made_.fields, name);
        if (found == made_.fields.end()) found = made_.fields.insert(found, name);
        emit({Code::field, 0.0, static_cast<std::size_t>(found - made_.fields.begin())}, 1);
        ++at_;
        return Kind::quantity;
    }
    Kind call() {
        const std::string name = word().text;
        constexpr std::pair<std::string_view, Code> functions[] = {{"abs", Code::absolute},
                                                                   {"min", Code::smaller},
                                                                   {"max", Code::larger},
                                                                   {"rate", Code::rate},
                                                                   {"growth", Code::growth}};
        const auto* function = std::ranges::find(functions, std::string_view(name),
                                                 &std::pair<std::string_view, Code>::first);
        if (function == std::end(functions))
            complain(
                "there is no function '" + name + "'",
                "there are abs(x), min(x, y), max(x, y), rate(x, seconds), growth(x, seconds)");
        at_ += 2;
        argument();
        const Code code = function->second;
        if (code == Code::absolute) {
            emit({code}, 0);
        } else if (code == Code::smaller || code == Code::larger) {
            expect(",");
            argument();
            emit({code}, -1);
        } else {
            expect(",");
            emit({code, window_length(), made_.windows++}, 0);
        }
        expect(")");
        return Kind::quantity;
    }
    void argument() {
        const std::size_t begin = word().column;
        need(disjunction(), Kind::quantity, begin);
    }
    double window_length() {
        if (word().kind != Word::Kind::number || word().value <= 0.0)
            complain("the window must be a number of seconds above zero", "write growth(x, 0.1)");
        return words_[at_++].value;
    }

    /// Limits the nesting of brackets and signs: input must not overflow the stack.
    struct Nesting {
        explicit Nesting(Parsing& of) : parsing(of) {
            if (++parsing.nesting_ > deepest_nesting)
                parsing.complain("the expression is nested too deeply", "write it flatter");
        }
        ~Nesting() { --parsing.nesting_; }
        Nesting(const Nesting&) = delete;
        Nesting& operator=(const Nesting&) = delete;
        Parsing& parsing;
    };

    const std::vector<std::string>& known_;
    std::vector<Word> words_;
    std::size_t at_ = 0;
    std::size_t height_ = 0;
    int nesting_ = 0;
    Expression made_;
};

}  // namespace

Expression parse(std::string_view text, Kind wanted, const std::string& pointer,
                 const std::vector<std::string>& known) {
    try {
        if (text.size() > longest_text)
            throw Complaint{longest_text, "the expression is too long",
                            "write at most 4096 characters"};
        return Parsing(text, known).whole(wanted);
    } catch (const Complaint& complaint) {
        throw fault::BadInput(
            "expression",
            {{pointer, "column " + std::to_string(complaint.column) + ": " + complaint.cause,
              complaint.remedy}});
    }
}

}  // namespace breach::criteria
