#include "shading/sheet/sheet_attributes.h"

#include "shading/expression/error.h"
#include "shading/expression/lexer.h"
#include "shading/sheet/compiled_sheet.h"

namespace burin {

void add_attributes_named_in(std::string_view expression, AttributeWish& wish) {
    try {
        Lexer lexer(expression);
        bool is_in_attr = false;  // behind "attr" and its bracket
        for (Token token = lexer.next(); token.kind != TokenKind::end; token = lexer.next()) {
            if (token.kind == TokenKind::text && is_in_attr && !token.words.empty() && !wish.wants(token.words))
                wish.named.emplace_back(token.words);
            is_in_attr = token.is_name("attr") || (is_in_attr && token.is("("));
            wish.uv = wish.uv || token.is_name("u") || token.is_name("v");
            wish.color = wish.color || token.is_name("Cv");
        }
    } catch (const ExpressionError&) {
        return;  // told when the sheet is compiled
    }
}

void add_attributes_named_in(const StyleValue& value, AttributeWish& wish) {
    const bool is_text = value.kind == StyleValue::Kind::ramp || value.kind == StyleValue::Kind::expression;
    if (is_text) add_attributes_named_in(value.source.text, wish);
}

AttributeWish attributes_named_in(const StyleSheet& sheet) {
    AttributeWish wish;
    for (const SheetLet& let : sheet.lets) add_attributes_named_in(let.text.text, wish);
    static_assert(kInkValueCount == 4, "each of them is looked at here");
    for (const SheetStyle& style : sheet.styles) {
        for (const StyleValue* const value : {&style.width, &style.opacity, &style.offset, &style.color})
            add_attributes_named_in(*value, wish);
    }
    return wish;
}

}  // namespace burin
