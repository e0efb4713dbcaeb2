/* One walk over the text cuts tokens, a second one pairs brackets and finds the block around each token. */
#include "scene_lexer.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

static bool is_word_start(unsigned char c)
{
    return isalpha(c) || c == '_' || c >= 0x80;
}

static bool is_word(unsigned char c)
{
    return is_word_start(c) || isdigit(c);
}

struct lexer {
    const char *name;
    const char *text;
    size_t size, at;
    int line;
};

static bool starts(const struct lexer *lexer, const char *two)
{
    return lexer->at + 1 < lexer->size && lexer->text[lexer->at] == two[0] && lexer->text[lexer->at + 1] == two[1];
}

static void step(struct lexer *lexer)
{
    char c = lexer->text[lexer->at++];
    lexer->line += c == '\n' || (c == '\r' && !(lexer->at < lexer->size && lexer->text[lexer->at] == '\n'));
}

static enum result skip_block_comment(struct lexer *lexer, struct error *err)
{
    int first_line = lexer->line, depth = 0;
    do {
        if (lexer->at >= lexer->size)
            return error_set(err, RESULT_DATA, "%s:%d: this comment has no end: write */", lexer->name, first_line);
        if (starts(lexer, "/*") || starts(lexer, "*/")) {
            depth += lexer->text[lexer->at] == '/' ? 1 : -1;
            lexer->at++;
        }
        step(lexer);
    } while (depth > 0);
    return RESULT_OK;
}

static enum result skip_space(struct lexer *lexer, struct error *err)
{
    while (lexer->at < lexer->size) {
        if (starts(lexer, "//")) {
            while (lexer->at < lexer->size && lexer->text[lexer->at] != '\n' && lexer->text[lexer->at] != '\r')
                lexer->at++;
        } else if (starts(lexer, "/*")) {
            enum result result = skip_block_comment(lexer, err);
            if (result)
                return result;
        } else if (isspace((unsigned char)lexer->text[lexer->at])) {
            step(lexer);
        } else {
            break;
        }
    }
    return RESULT_OK;
}

static enum result skip_string(struct lexer *lexer, struct error *err)
{
    int first_line = lexer->line;
    lexer->at++;
    while (lexer->at < lexer->size && lexer->text[lexer->at] != '"') {
        if (lexer->text[lexer->at] == '\\' && lexer->at + 1 < lexer->size)
            step(lexer);
        step(lexer);
    }
    if (lexer->at >= lexer->size)
        return error_set(err, RESULT_DATA, "%s:%d: this string has no end: write \"", lexer->name, first_line);
    lexer->at++;
    return RESULT_OK;
}

static void skip_number(struct lexer *lexer)
{
    const char *text = lexer->text;
    size_t at = lexer->at;
    while (at < lexer->size && (isdigit((unsigned char)text[at]) || text[at] == '.'))
        at++;
    if (at < lexer->size && (text[at] == 'e' || text[at] == 'E')) {
        size_t digits = at + 1;
        if (digits < lexer->size && (text[digits] == '+' || text[digits] == '-'))
            digits++;
        if (digits < lexer->size && isdigit((unsigned char)text[digits])) {
            at = digits;
            while (at < lexer->size && isdigit((unsigned char)text[at]))
                at++;
        }
    }
    lexer->at = at;
}

static void skip_word(struct lexer *lexer)
{
    while (lexer->at < lexer->size && is_word((unsigned char)lexer->text[lexer->at]))
        lexer->at++;
}

static enum result next_token(struct lexer *lexer, struct token *token, struct error *err)
{
    enum result result = skip_space(lexer, err);
    if (result)
        return result;
    *token = (struct token){.begin = lexer->at, .line = lexer->line, .match = -1, .parent = -1};
    if (lexer->at >= lexer->size) {
        token->kind = TOKEN_END;
        token->end = lexer->at;
        return RESULT_OK;
    }
    unsigned char c = (unsigned char)lexer->text[lexer->at];
    unsigned char after = lexer->at + 1 < lexer->size ? (unsigned char)lexer->text[lexer->at + 1] : 0;
    if (is_word_start(c)) {
        token->kind = TOKEN_WORD;
        token->word = lexer->at;
        skip_word(lexer);
        token->word_length = lexer->at - token->word;
    } else if (isdigit(c) || (c == '.' && isdigit(after))) {
        token->kind = TOKEN_NUMBER;
        skip_number(lexer);
    } else if (c == '"') {
        token->kind = TOKEN_STRING;
        result = skip_string(lexer, err);
    } else if (c == '#') {
        token->kind = TOKEN_DIRECTIVE;
        lexer->at++;
        result = skip_space(lexer, err);
        token->word = lexer->at;
        skip_word(lexer);
        token->word_length = lexer->at - token->word;
    } else {
        token->kind = TOKEN_MARK;
        lexer->at++;
    }
    token->end = lexer->at;
    return result;
}

/* Pairs brackets in one walk over a stack that is threaded through the `match` fields. A closing bracket that doesn't fit
 * the innermost open one stays unpaired. */
static void match_brackets(const char *text, struct token_list *list)
{
    int open = -1, brace = -1;
    for (int i = 0; i < list->count; i++) {
        struct token *token = &list->tokens[i];
        char c = token->kind == TOKEN_MARK ? text[token->begin] : 0;
        if (c == '}' || c == ')') {
            char opening = c == '}' ? '{' : '(';
            if (open >= 0 && text[list->tokens[open].begin] == opening) {
                int outer = list->tokens[open].match;
                if (c == '}')
                    brace = list->tokens[open].parent;
                list->tokens[open].match = i;
                token->match = open;
                open = outer;
            }
        }
        token->parent = brace;
        if (c == '{' || c == '(') {
            token->match = open;
            open = i;
            if (c == '{')
                brace = i;
        }
    }
    while (open >= 0) {
        int outer = list->tokens[open].match;
        list->tokens[open].match = -1;
        open = outer;
    }
    /* What isn't closed isn't around anything. */
    for (int i = 0; i < list->count; i++) {
        int parent = list->tokens[i].parent;
        if (parent >= 0 && list->tokens[parent].match < 0)
            list->tokens[i].parent = list->tokens[parent].parent;
    }
}

enum result scene_lex(const char *name, const struct buffer *source, struct token_list *list, struct error *err)
{
    struct lexer lexer = {.name = name, .text = source->data, .size = source->size, .line = 1};
    struct buffer tokens = {0};
    struct token token;
    *list = (struct token_list){0};
    if (source->size >= 3 && !memcmp(source->data, "\xEF\xBB\xBF", 3))
        lexer.at = 3;
    do {
        enum result result = next_token(&lexer, &token, err);
        if (!result)
            result = buffer_add(&tokens, &token, sizeof token, err);
        if (result) {
            buffer_free(&tokens);
            return result;
        }
    } while (token.kind != TOKEN_END);
    list->tokens = (struct token *)(void *)tokens.data;
    list->count = (int)(tokens.size / sizeof token);
    match_brackets(source->data, list);
    return RESULT_OK;
}

void token_list_free(struct token_list *list)
{
    free(list->tokens);
    *list = (struct token_list){0};
}

bool token_is(const struct buffer *source, const struct token *token, enum token_kind kind, const char *word)
{
    size_t begin = token->begin, length = token->end - token->begin;
    if (kind == TOKEN_WORD || kind == TOKEN_DIRECTIVE) {
        begin = token->word;
        length = token->word_length;
    }
    return token->kind == kind && length == strlen(word) && !memcmp(source->data + begin, word, length);
}
