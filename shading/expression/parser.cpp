#include <algorithm>
#include <string>

#include "shading/expression/error.h"
#include "shading/expression/syntax_tree.h"

namespace burin {
namespace {

constexpr std::array<std::string_view, 6> kComparisons{"<", "<=", ">", ">=", "==", "!="};

class Parser {
  public:
    explicit Parser(std::string_view text) : text_(text), lexer_(text), token_(lexer_.next()) {}

    SyntaxTree parse() {
        value();
        if (token_.kind == TokenKind::end) return std::move(tree_);
        if (token_.is(")")) fail("')' has no '('");
        if (token_.is_name("in")) fail("'in' needs a variable on its left, as object in wheels");
        fail("an operator is missing before " + shown(token_));
    }

  private:
    using Index = std::uint32_t;

    /// Counts how deep the text is nested.
    class Level {
      public:
        explicit Level(Parser& parser) : parser_(parser) {
            if (++parser_.levels_ > kMostExpressionLevels)
                parser_.fail("the expression is nested more than 64 levels deep: move parts of it into [let]");
        }
        ~Level() { --parser_.levels_; }
        Level(const Level&) = delete;
        Level& operator=(const Level&) = delete;

      private:
        Parser& parser_;
    };

    [[noreturn]] void fail(const std::string& message) const {
        throw ExpressionError(column_of(text_, token_.offset), message);
    }
    static std::string shown(const Token& token) {
        if (token.kind == TokenKind::text) return "a text";
        return in_quotes(token.words);
    }
    Token take() {
        Token taken = token_;
        token_ = lexer_.next();
        return taken;
    }
    void expect(std::string_view symbol) {
        if (token_.is(symbol)) {
            take();
            return;
        }
        const std::string expected = "'" + std::string(symbol) + "' expected";
        fail(token_.kind == TokenKind::end ? expected + " before the end" : expected + " before " + shown(token_));
    }

    Index add(SyntaxKind kind, const Token& token, std::size_t begin, std::initializer_list<Index> operands = {}) {
        const std::size_t first = tree_.operands.size();
        tree_.operands.insert(tree_.operands.end(), operands);
        tree_.nodes.push_back({kind, token, first, operands.size(), begin});
        return static_cast<Index>(tree_.nodes.size() - 1);
    }
    std::size_t begin_of(Index node) const { return tree_.nodes[node].begin; }

    Index value() {
        const Level level(*this);
        const Index condition = any_of();
        if (!token_.is("?")) return condition;
        const Token mark = take();
        const Index yes = value();
        expect(":");
        const Index no = value();
        return add(SyntaxKind::choose, mark, begin_of(condition), {condition, yes, no});
    }

    template <typename IsOperator, typename Operand>
    Index chain(const IsOperator& is_operator, const Operand& operand) {
        Index left = operand();
        while (is_operator()) {
            const Token sign = take();
            const Index right = operand();
            left = add(SyntaxKind::binary, sign, begin_of(left), {left, right});
        }
        return left;
    }
    Index any_of() {
        return chain([&] { return token_.is_name("or"); }, [&] { return all_of(); });
    }
    Index all_of() {
        return chain([&] { return token_.is_name("and"); }, [&] { return negation(); });
    }
    Index negation() {
        if (!token_.is_name("not")) return comparison();
        const Level level(*this);
        const Token sign = take();
        const Index operand = negation();
        return add(SyntaxKind::unary, sign, sign.offset, {operand});
    }

    bool at_comparison() const {
        return token_.is_name("in") ||
               (token_.kind == TokenKind::symbol &&
                std::find(kComparisons.begin(), kComparisons.end(), token_.words) != kComparisons.end());
    }
    Index comparison() {
        Index left = sum();
        if (!at_comparison()) return left;
        const Token sign = take();
        if (sign.kind == TokenKind::name) {
            if (token_.kind != TokenKind::name) fail("the name of a group is missing after 'in'");
            const Token group = take();
            left = add(SyntaxKind::in, group, begin_of(left), {left});
        } else {
            const Index right = sum();
            left = add(SyntaxKind::binary, sign, begin_of(left), {left, right});
        }
        if (at_comparison()) fail("comparisons cannot be chained: use 'and'");
        return left;
    }
    Index sum() {
        return chain([&] { return token_.is("+") || token_.is("-"); }, [&] { return product(); });
    }
    Index product() {
        return chain([&] { return token_.is("*") || token_.is("/") || token_.is("%"); }, [&] { return unary(); });
    }
    Index unary() {
        if (!token_.is("-")) return power();
        const Level level(*this);
        const Token sign = take();
        const Index operand = unary();
        return add(SyntaxKind::unary, sign, sign.offset, {operand});
    }
    Index power() {
        const Index base = postfix();
        if (!token_.is("^")) return base;
        const Level level(*this);
        const Token sign = take();
        const Index exponent = unary();
        return add(SyntaxKind::binary, sign, begin_of(base), {base, exponent});
    }
    Index postfix() {
        Index whole = atom();
        while (token_.is(".")) {
            take();
            const bool is_component = token_.kind == TokenKind::name && token_.words.size() == 1 &&
                                      std::string_view("xyzrgb").find(token_.words) != std::string_view::npos;
            if (!is_component) fail("a component is one of .x .y .z or .r .g .b");
            whole = add(SyntaxKind::component, take(), begin_of(whole), {whole});
        }
        return whole;
    }

    [[noreturn]] void fail_without_value() const {
        if (token_.kind == TokenKind::end) fail("a value is missing at the end");
        if (token_.is_name("not")) fail("'not' needs brackets here: (not ...)");
        fail("a value is missing before " + shown(token_));
    }
    Index atom() {
        switch (token_.kind) {
            case TokenKind::number:
                return leaf(SyntaxKind::number);
            case TokenKind::color:
                return leaf(SyntaxKind::color);
            case TokenKind::text:
                return leaf(SyntaxKind::text);
            case TokenKind::name:
                break;
            default:
                if (!token_.is("(")) fail_without_value();
                take();
                const Index inner = value();
                expect(")");
                return inner;
        }
        if (token_.is_name("and") || token_.is_name("or") || token_.is_name("not") || token_.is_name("in"))
            fail_without_value();
        const Token name = take();
        return token_.is("(") ? call(name) : add(SyntaxKind::name, name, name.offset);
    }
    Index leaf(SyntaxKind kind) {
        const Token token = take();
        return add(kind, token, token.offset);
    }
    Index call(const Token& name) {
        take();
        std::vector<Index> arguments;
        if (!token_.is(")")) {
            arguments.push_back(value());
            while (token_.is(",")) {
                take();
                arguments.push_back(value());
            }
        }
        expect(")");
        const Index node = add(SyntaxKind::call, name, name.offset);
        tree_.operands.insert(tree_.operands.end(), arguments.begin(), arguments.end());
        tree_.nodes.back().operands = arguments.size();
        return node;
    }

    std::string_view text_;
    Lexer lexer_;
    Token token_;
    SyntaxTree tree_;
    int levels_ = 0;
};

}  // namespace

SyntaxTree parse_expression(std::string_view text) {
    if (column_of(text, text.size()) > kMostExpressionCharacters + 1)
        throw ExpressionError(kMostExpressionCharacters + 1,
                              "the expression is longer than 4096 characters: move parts of it into [let]");
    return Parser(text).parse();
}

}  // namespace burin
