/* One walk over the text cuts tokens, a second one pairs brackets and finds the block around each token. */
#include "scene_lexer.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

/* POV-Ray itself counts 200 nested braces, warns and reads on; the rewriter's recursion has a stack's depth. */
enum { MAX_CONDITIONALS = 256, MAX_BRACKETS = 1000 };

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

/* Brackets that are open, innermost last: indices of tokens, in a buffer. */
static int stack_count(const struct buffer *stack)
{
    return (int)(stack->size / sizeof(int));
}

static int stack_top(const struct buffer *stack)
{
    return stack->size ? ((const int *)(const void *)stack->data)[stack_count(stack) - 1] : -1;
}

static enum result stack_copy(struct buffer *to, const struct buffer *from, struct error *err)
{
    to->size = 0;
    return from->size ? buffer_add(to, from->data, from->size, err) : RESULT_OK;
}

/* A conditional: the brackets that were open before it, and after a branch that opened or closed some. */
struct branches {
    struct buffer before, after;
    bool changed;
};

static bool in_words(const struct buffer *source, const struct token *token, const char *const *words)
{
    for (; *words; words++)
        if (token_is(source, token, TOKEN_DIRECTIVE, *words))
            return true;
    return false;
}

/* A bracket that an earlier branch opened in the place of one of this branch closes with it: twin[earlier] = later. */
static enum result end_branch(struct branches *branches, const struct buffer *open, int *twin, struct error *err)
{
    if (stack_count(open) == stack_count(&branches->before))
        return RESULT_OK;
    const int *earlier = (const int *)(const void *)branches->after.data, *later = (const int *)(const void *)open->data;
    int count = stack_count(open);
    for (int i = stack_count(&branches->before); branches->changed && stack_count(&branches->after) == count && i < count; i++)
        twin[earlier[i]] = later[i];
    branches->changed = true;
    return stack_copy(&branches->after, open, err);
}

/* Of a conditional's branches one is parsed: each begins with the brackets that were open before it, and what follows
 * it with those of a branch that opened or closed some. */
static enum result follow_branches(const struct buffer *source, const struct token *token, bool switch_default,
                                   struct branches *conditionals, int *depth, struct buffer *open, int *twin,
                                   struct error *err)
{
    static const char *const openers[] = {"if", "ifdef", "ifndef", "while", "for", "switch", "macro", NULL};
    static const char *const others[] = {"else", "elseif", "case", "range", NULL};
    enum result result = RESULT_OK;
    if (in_words(source, token, openers) && *depth < MAX_CONDITIONALS) {
        struct branches *branches = &conditionals[(*depth)++];
        branches->changed = false;
        return stack_copy(&branches->before, open, err);
    }
    struct branches *branches = *depth > 0 ? &conditionals[*depth - 1] : NULL;
    if (branches && (switch_default || in_words(source, token, others))) {
        result = end_branch(branches, open, twin, err);
        return result ? result : stack_copy(open, &branches->before, err);
    }
    if (branches && token_is(source, token, TOKEN_DIRECTIVE, "end")) {
        --*depth;
        result = end_branch(branches, open, twin, err);
        if (!result && branches->changed)
            result = stack_copy(open, &branches->after, err);
    }
    return result;
}

/* Pairs brackets in one walk. A closing bracket that doesn't fit the innermost open one stays unpaired. */
static enum result match_brackets(const char *name, const struct buffer *source, struct token_list *list,
                                  struct error *err)
{
    struct buffer open = {0};
    struct branches *conditionals = calloc(MAX_CONDITIONALS, sizeof *conditionals);
    int *twin = calloc((size_t)list->count, sizeof *twin);
    enum result result = conditionals && twin ? RESULT_OK : error_memory(err, (double)list->count * sizeof *twin);
    int depth = 0;
    for (int i = 0; !result && i < list->count; i++) {
        struct token *token = &list->tokens[i];
        const char *text = source->data;
        if (token->kind == TOKEN_DIRECTIVE) {
            const struct token *next = &list->tokens[i + 1];
            bool block = next->kind == TOKEN_MARK && text[next->begin] == '{';
            bool switch_default = !block && token_is(source, token, TOKEN_DIRECTIVE, "default");
            result = follow_branches(source, token, switch_default, conditionals, &depth, &open, twin, err);
        }
        char c = token->kind == TOKEN_MARK ? text[token->begin] : 0;
        int top = stack_top(&open);
        if ((c == '}' || c == ')') && top >= 0 && text[list->tokens[top].begin] == (c == '}' ? '{' : '(')) {
            list->tokens[top].match = i;
            token->match = top;
            open.size -= sizeof(int);
        }
        top = stack_top(&open);
        token->parent = top >= 0 && text[list->tokens[top].begin] != '{' ? list->tokens[top].parent : top;
        if (!result && (c == '{' || c == '('))
            result = stack_count(&open) < MAX_BRACKETS
                         ? buffer_add(&open, &i, sizeof i, err)
                         : error_set(err, RESULT_DATA,
                                     "%s:%d: more than %d brackets are open here: declare inner parts by names", name,
                                     token->line, MAX_BRACKETS);
    }
    for (int i = 0; conditionals && i < MAX_CONDITIONALS; i++) {
        buffer_free(&conditionals[i].before);
        buffer_free(&conditionals[i].after);
    }
    free(conditionals);
    buffer_free(&open);
    for (int i = list->count - 1; !result && i >= 0; i--)
        if (twin[i] && list->tokens[i].match < 0)
            list->tokens[i].match = list->tokens[twin[i]].match;
    free(twin);
    /* What isn't closed isn't around anything; in branches a block may be closed before what it seems to be around. */
    for (int i = 0; !result && i < list->count; i++) {
        int *parent = &list->tokens[i].parent;
        while (*parent >= 0 && list->tokens[*parent].match < i)
            *parent = list->tokens[*parent].parent;
    }
    return result;
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
    return match_brackets(name, source, list, err);
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
