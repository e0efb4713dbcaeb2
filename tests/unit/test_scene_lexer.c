/* Tokens of the scene language, written down one by one: D directive, W word, N number, S string, M mark. */
#include "scene_lexer.h"

#include "gloss_support.h"

static struct buffer buffer_of(const char *text, size_t size)
{
    struct buffer buffer = {0};
    struct error err;
    assert_ok(buffer_add(&buffer, text, size, &err), err);
    return buffer;
}

/* "W:sphere M:{ ..." of a source; for directives and words the name itself. */
static void describe(const char *text, size_t size, struct buffer *description)
{
    struct buffer source = buffer_of(text, size);
    struct token_list list;
    struct error err;
    *description = (struct buffer){0};
    assert_ok(buffer_add(description, "", 0, &err), err);
    assert_ok(scene_lex("x.pov", &source, &list, &err), err);
    assert_true(list.count > 0);
    size_t end = 0;
    for (int i = 0; i < list.count; i++) {
        const struct token *token = &list.tokens[i];
        assert_true(token->begin >= end && token->end >= token->begin && token->end <= size);
        end = token->end;
        if (token->kind == TOKEN_END) {
            assert_int_equal(i, list.count - 1);
            assert_true(token->begin == size && token->end == size);
            break;
        }
        bool named = token->kind == TOKEN_WORD || token->kind == TOKEN_DIRECTIVE;
        size_t begin = named ? token->word : token->begin;
        size_t length = named ? token->word_length : token->end - token->begin;
        assert_ok(buffer_printf(description, &err, "%s%c:", i ? " " : "", "WDNSM"[token->kind]), err);
        assert_ok(buffer_add(description, source.data + begin, length, &err), err);
    }
    token_list_free(&list);
    assert_null(list.tokens);
    buffer_free(&source);
}

static void assert_tokens(const char *text, const char *expected)
{
    struct buffer description;
    describe(text, strlen(text), &description);
    assert_string_equal(description.data, expected);
    buffer_free(&description);
}

static void lex__a_small_scene__its_tokens(void **state)
{
    (void)state;
    assert_tokens("#declare R = 1.5;\nsphere { <0, -1, R*2>, R pigment{rgb 1} }\n",
                  "D:declare W:R M:= N:1.5 M:; W:sphere M:{ M:< N:0 M:, M:- N:1 M:, W:R M:* N:2 M:> M:, W:R W:pigment M:{ "
                  "W:rgb N:1 M:} M:}");
}

static void lex__comments__skipped_also_nested_ones(void **state)
{
    (void)state;
    assert_tokens("a // b\nc", "W:a W:c");
    assert_tokens("a /* b */ c", "W:a W:c");
    assert_tokens("a /* b /* c */ d */ e", "W:a W:e");
    assert_tokens("a /**/ b /***/ c /*/ */ d", "W:a W:b W:c W:d");
    assert_tokens("a/*/* */*/b", "W:a W:b");
    assert_tokens("a /* // */ b", "W:a W:b");
    assert_tokens("a // /* b\nc", "W:a W:c");
    assert_tokens("a /* \" */ b", "W:a W:b");
    assert_tokens("a // \"\nb", "W:a W:b");
    assert_tokens("a / b */ c", "W:a M:/ W:b M:* M:/ W:c");
    assert_tokens("// only a comment", "");
    assert_tokens("a//", "W:a");
}

static void lex__strings__kept_whole(void **state)
{
    (void)state;
    assert_tokens("\"a // b\" c", "S:\"a // b\" W:c");
    assert_tokens("\"/*\" c", "S:\"/*\" W:c");
    assert_tokens("\"a\\\"b\" c", "S:\"a\\\"b\" W:c");
    assert_tokens("\"a\\\\\" c", "S:\"a\\\\\" W:c");
    assert_tokens("\"\" \"#end { }\"", "S:\"\" S:\"#end { }\"");
    assert_tokens("\"a\nb\"c", "S:\"a\nb\" W:c");
}

static void lex__numbers__one_token_each(void **state)
{
    (void)state;
    assert_tokens("1 1e5 .5 1.e3 5. 1E-5 1.5e+10", "N:1 N:1e5 N:.5 N:1.e3 N:5. N:1E-5 N:1.5e+10");
    assert_tokens("5..", "N:5..");
    assert_tokens("1e 1e+ 2exp", "N:1 W:e N:1 W:e M:+ N:2 W:exp");
    assert_tokens("-1+2", "M:- N:1 M:+ N:2");
    assert_tokens("x2 2x _1", "W:x2 N:2 W:x W:_1");
    assert_tokens("a.b .x . 1.x", "W:a M:. W:b M:. W:x M:. N:1. W:x");
}

static void lex__directives__spaces_after_the_hash(void **state)
{
    (void)state;
    assert_tokens("#if(1)#end # declare #\tlocal #\n  else", "D:if M:( N:1 M:) D:end D:declare D:local D:else");
    assert_tokens("# /* c */ macro #", "D:macro D:");
    assert_tokens("a#b", "W:a D:b");
}

static void lex__bytes_above_127__parts_of_words(void **state)
{
    (void)state;
    assert_tokens("Größe = \"ß\"; // ü\nπ2", "W:Größe M:= S:\"ß\" M:; W:π2");
    assert_tokens("\xff\x80{", "W:\xff\x80 M:{");
}

static void lex__byte_order_mark__skipped_at_the_start_only(void **state)
{
    (void)state;
    assert_tokens("\xEF\xBB\xBF#version 3.7;", "D:version N:3.7 M:;");
    assert_tokens("\xEF\xBB\xBF", "");
    assert_tokens("a \xEF\xBB\xBF", "W:a W:\xEF\xBB\xBF");
    assert_tokens("\xEF\xBB", "W:\xEF\xBB");
}

static void lex__line_ends_of_dos_and_old_macs__white_space(void **state)
{
    (void)state;
    assert_tokens("a // c\r\nb\r\n#end\r\n", "W:a W:b D:end");
    assert_tokens("a // c\rb // d\rc", "W:a W:b W:c");
    assert_tokens("\fa\v\tb", "W:a W:b");
}

static void lex__nul_bytes__marks(void **state)
{
    (void)state;
    struct buffer description;
    static const char text[] = "a\0b \"c\0d\" /* \0 */ 1\0";
    describe(text, sizeof text - 1, &description);
    static const char expected[] = "W:a M:\0 W:b S:\"c\0d\" N:1 M:\0";
    assert_int_equal(description.size, sizeof expected - 1);
    assert_memory_equal(description.data, expected, sizeof expected - 1);
    buffer_free(&description);
}

static void lex__empty_or_blank__only_the_end(void **state)
{
    (void)state;
    struct buffer none = {0};
    struct token_list list;
    struct error err;
    assert_ok(scene_lex("x.pov", &none, &list, &err), err);
    assert_int_equal(list.count, 1);
    assert_int_equal(list.tokens[0].kind, TOKEN_END);
    assert_int_equal(list.tokens[0].line, 1);
    token_list_free(&list);
    assert_tokens("", "");
    assert_tokens(" \n\t\r\n", "");
}

static void lex__no_newline_at_the_end__last_token_whole(void **state)
{
    (void)state;
    assert_tokens("a", "W:a");
    assert_tokens("#end", "D:end");
    assert_tokens("1.5", "N:1.5");
    assert_tokens("\"s\"", "S:\"s\"");
    assert_tokens("1e", "N:1 W:e");
    assert_tokens("/", "M:/");
    assert_tokens("/* */", "");
}

static void assert_lines(const char *text, const int *lines, int count)
{
    struct buffer source = buffer_of(text, strlen(text));
    struct token_list list;
    struct error err;
    assert_ok(scene_lex("x.pov", &source, &list, &err), err);
    assert_int_equal(list.count, count);
    for (int i = 0; i < count; i++)
        assert_int_equal(list.tokens[i].line, lines[i]);
    token_list_free(&list);
    buffer_free(&source);
}

static void lex__lines__counted_from_1_where_tokens_begin(void **state)
{
    (void)state;
    assert_lines("a\n\nb /* \n\n */ c\n\"d\ne\" f\n", (int[]){1, 3, 5, 6, 7, 8}, 6);
    assert_lines("a\r\nb // x\r\nc\r\n", (int[]){1, 2, 3, 4}, 4);
    assert_lines("a\rb // x\rc\r", (int[]){1, 2, 3, 4}, 4);
    assert_lines("a // x\n// y\n#\n\nif \"\\\n\" b", (int[]){1, 3, 5, 6, 6}, 5);
}

static void assert_unclosed(const char *text, const char *message)
{
    struct buffer source = buffer_of(text, strlen(text));
    struct token_list list = {.count = 7};
    struct error err;
    assert_int_equal(scene_lex("dir/x.pov", &source, &list, &err), RESULT_DATA);
    assert_non_null(strstr(err.text, message));
    assert_null(list.tokens);
    assert_int_equal(list.count, 0);
    buffer_free(&source);
}

static void lex__unclosed_comment_or_string__file_and_line_where_it_begins(void **state)
{
    (void)state;
    assert_unclosed("a\n\n/* b\n\n", "dir/x.pov:3: this comment");
    assert_unclosed("/*", "dir/x.pov:1: this comment");
    assert_unclosed("/*/", "dir/x.pov:1: this comment");
    assert_unclosed("\n/* /* */\n*", "dir/x.pov:2: this comment");
    assert_unclosed("a\n#  /* b", "dir/x.pov:2: this comment");
    assert_unclosed("a\nb \"c\nd", "dir/x.pov:2: this string");
    assert_unclosed("\"", "dir/x.pov:1: this string");
    assert_unclosed("\"a\\\"", "dir/x.pov:1: this string");
    assert_unclosed("\"a\\", "dir/x.pov:1: this string");
}

/* For each bracket of the text the index of its partner among the tokens (-1: none), and of each token its parent. */
static void assert_brackets(const char *text, const int *matches, const int *parents, int count)
{
    struct buffer source = buffer_of(text, strlen(text));
    struct token_list list;
    struct error err;
    assert_ok(scene_lex("x.pov", &source, &list, &err), err);
    assert_int_equal(list.count, count + 1);
    for (int i = 0; i < count; i++)
        if (list.tokens[i].match != matches[i] || list.tokens[i].parent != parents[i])
            fail_msg("%s: token %d has match %d, parent %d", text, i, list.tokens[i].match, list.tokens[i].parent);
    token_list_free(&list);
    buffer_free(&source);
}

static void lex__balanced_brackets__matched_with_the_brace_around(void **state)
{
    (void)state;
    assert_brackets("a{b(c)}d", (int[]){-1, 6, -1, 5, -1, 3, 1, -1}, (int[]){-1, -1, 1, 1, 1, 1, -1, -1}, 8);
    assert_brackets("{{}{x}}", (int[]){6, 2, 1, 5, -1, 3, 0}, (int[]){-1, 0, 0, 0, 3, 0, -1}, 7);
    assert_brackets("\"{\" /*{*/ }", (int[]){-1, -1}, (int[]){-1, -1}, 2);
}

static void lex__unbalanced_brackets__minus_1(void **state)
{
    (void)state;
    assert_brackets("{a", (int[]){-1, -1}, (int[]){-1, -1}, 2);
    assert_brackets("{{{a}b", (int[]){-1, -1, 4, -1, 2, -1}, (int[]){-1, -1, -1, 2, -1, -1}, 6);
    assert_brackets("}a", (int[]){-1, -1}, (int[]){-1, -1}, 2);
    assert_brackets("{{}", (int[]){-1, 2, 1}, (int[]){-1, -1, -1}, 3);
    assert_brackets("{}}", (int[]){1, 0, -1}, (int[]){-1, -1, -1}, 3);
    /* A closing bracket that doesn't fit the innermost open one stays alone, and so does that one. */
    assert_brackets("{(})", (int[]){-1, 3, -1, 1}, (int[]){-1, -1, -1, -1}, 4);
    assert_brackets("({)}", (int[]){-1, 3, -1, 1}, (int[]){-1, -1, 1, -1}, 4);
}

static void lex__deep_nesting__every_pair_or_refused(void **state)
{
    (void)state;
    enum { DEPTH = 1000 };
    struct buffer source = {0};
    struct token_list list;
    struct error err;
    for (int i = 0; i < 2 * DEPTH; i++)
        assert_ok(buffer_add(&source, i < DEPTH ? "{" : "}", 1, &err), err);
    assert_ok(scene_lex("x.pov", &source, &list, &err), err);
    assert_int_equal(list.count, 2 * DEPTH + 1);
    for (int i = 0; i < 2 * DEPTH; i++)
        assert_int_equal(list.tokens[i].match, 2 * DEPTH - 1 - i);
    token_list_free(&list);
    source.size = DEPTH;
    assert_ok(buffer_add_text(&source, "\n(", &err), err);
    assert_int_equal(scene_lex("x.pov", &source, &list, &err), RESULT_DATA);
    assert_non_null(strstr(err.text, "x.pov:2: more than 1000 brackets"));
    token_list_free(&list);
    buffer_free(&source);
}

static void token_is__kind_and_whole_word__both_needed(void **state)
{
    (void)state;
    static const char text[] = "# declare finish finishes \"finish\" { 12";
    struct buffer source = buffer_of(text, strlen(text));
    struct token_list list;
    struct error err;
    assert_ok(scene_lex("x.pov", &source, &list, &err), err);
    const struct token *tokens = list.tokens;
    assert_true(token_is(&source, &tokens[0], TOKEN_DIRECTIVE, "declare"));
    assert_false(token_is(&source, &tokens[0], TOKEN_WORD, "declare"));
    assert_false(token_is(&source, &tokens[0], TOKEN_DIRECTIVE, "declar"));
    assert_true(token_is(&source, &tokens[1], TOKEN_WORD, "finish"));
    assert_false(token_is(&source, &tokens[1], TOKEN_WORD, "Finish"));
    assert_false(token_is(&source, &tokens[2], TOKEN_WORD, "finish"));
    assert_false(token_is(&source, &tokens[3], TOKEN_WORD, "finish"));
    assert_true(token_is(&source, &tokens[4], TOKEN_MARK, "{"));
    assert_false(token_is(&source, &tokens[4], TOKEN_MARK, "}"));
    assert_true(token_is(&source, &tokens[5], TOKEN_NUMBER, "12"));
    assert_false(token_is(&source, &tokens[6], TOKEN_WORD, "12"));
    token_list_free(&list);
    buffer_free(&source);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lex__a_small_scene__its_tokens),
        cmocka_unit_test(lex__comments__skipped_also_nested_ones),
        cmocka_unit_test(lex__strings__kept_whole),
        cmocka_unit_test(lex__numbers__one_token_each),
        cmocka_unit_test(lex__directives__spaces_after_the_hash),
        cmocka_unit_test(lex__bytes_above_127__parts_of_words),
        cmocka_unit_test(lex__byte_order_mark__skipped_at_the_start_only),
        cmocka_unit_test(lex__line_ends_of_dos_and_old_macs__white_space),
        cmocka_unit_test(lex__nul_bytes__marks),
        cmocka_unit_test(lex__empty_or_blank__only_the_end),
        cmocka_unit_test(lex__no_newline_at_the_end__last_token_whole),
        cmocka_unit_test(lex__lines__counted_from_1_where_tokens_begin),
        cmocka_unit_test(lex__unclosed_comment_or_string__file_and_line_where_it_begins),
        cmocka_unit_test(lex__balanced_brackets__matched_with_the_brace_around),
        cmocka_unit_test(lex__unbalanced_brackets__minus_1),
        cmocka_unit_test(lex__deep_nesting__every_pair_or_refused),
        cmocka_unit_test(token_is__kind_and_whole_word__both_needed),
    };
    return cmocka_run_group_tests_name("scene_lexer", tests, NULL, NULL);
}
