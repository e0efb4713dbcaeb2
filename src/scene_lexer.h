/* Tokens of the POV-Ray scene language, as places in the source text.
 *
 * Comments (which nest), strings with escapes and white space lie between tokens, so that a rewritten scene keeps its
 * lines: what isn't changed is copied from the source.
 */
#ifndef POVGLOSS_SCENE_LEXER_H
#define POVGLOSS_SCENE_LEXER_H

#include "mem.h"

#include <stdbool.h>

struct scene_name;

enum token_kind {
    TOKEN_WORD,      /* keyword or identifier */
    TOKEN_DIRECTIVE, /* #word; `word` holds the word without the # */
    TOKEN_NUMBER,
    TOKEN_STRING, /* with its quotes */
    TOKEN_MARK,   /* any other single character */
    TOKEN_END,    /* the end of the file: one always stands last */
};

struct token {
    enum token_kind kind;
    size_t begin, end;        /* bytes of the source */
    size_t word, word_length; /* directives and words: the name itself */
    int line;                 /* from 1 */
    int match;                /* of { } ( ): the token that closes or opens it; -1: none */
    int parent;               /* the innermost paired { around the token; -1: none */
    struct scene_name *name;  /* of a word, once its file belongs to a scene; else NULL */
    unsigned around;          /* what the paired { around the token open, once its file belongs to a scene: scene.h */
};

struct token_list {
    struct token *tokens;
    int count; /* with TOKEN_END */
};

/* Cuts the source into tokens; the caller frees them. An unclosed comment or string is RESULT_DATA, with `name` and the
 * line where it begins, and so are more than 1000 open brackets. Braces may be unbalanced (macros and conditionals do
 * that): their match is -1. */
MUST_CHECK enum result scene_lex(const char *name, const struct buffer *source, struct token_list *list,
                                 struct error *err);
void token_list_free(struct token_list *list);

/* Whether the token is that keyword or identifier, directive or mark. */
bool token_is(const struct buffer *source, const struct token *token, enum token_kind kind, const char *word);

#endif
