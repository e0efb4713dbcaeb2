/* Growing buffers and whole files. */
#include "mem.h"

#include "io_support.h"

static void buffer__many_small_pieces__all_there_with_a_nul(void **state)
{
    (void)state;
    struct buffer buffer = {0};
    struct error err;
    for (int n = 0; n < 10000; n++) {
        char piece[3] = {(char)n, (char)(n >> 8), 0};
        assert_ok(buffer_add(&buffer, piece, 2, &err), err);
        assert_int_equal(buffer.data[buffer.size], 0);
        assert_true(buffer.size < buffer.capacity);
    }
    assert_int_equal(buffer.size, 20000);
    for (int n = 0; n < 10000; n++) {
        assert_int_equal(buffer.data[2 * n], (char)n);
        assert_int_equal(buffer.data[2 * n + 1], (char)(n >> 8));
    }
    buffer_free(&buffer);
    assert_null(buffer.data);
    assert_int_equal(buffer.size, 0);
    assert_int_equal(buffer.capacity, 0);
    buffer_free(&buffer);
}

static void buffer__nothing_added__an_empty_string(void **state)
{
    (void)state;
    struct buffer buffer = {0};
    struct error err;
    assert_ok(buffer_add(&buffer, NULL, 0, &err), err);
    assert_string_equal(buffer.data, "");
    assert_ok(buffer_add_text(&buffer, "", &err), err);
    assert_int_equal(buffer.size, 0);
    buffer_free(&buffer);
}

static void buffer__nul_bytes__kept(void **state)
{
    (void)state;
    struct buffer buffer = {0};
    struct error err;
    assert_ok(buffer_add(&buffer, "a\0b", 3, &err), err);
    assert_ok(buffer_add_text(&buffer, "c", &err), err);
    assert_int_equal(buffer.size, 4);
    assert_memory_equal(buffer.data, "a\0bc", 5);
    buffer_free(&buffer);
}

static void buffer_printf__long_text__appended(void **state)
{
    (void)state;
    struct buffer buffer = {0};
    struct error err;
    assert_ok(buffer_add_text(&buffer, "x=", &err), err);
    assert_ok(buffer_printf(&buffer, &err, "%d,%0*d,%s", 42, 5000, 7, "end"), err);
    assert_int_equal(buffer.size, 2 + 3 + 5000 + 1 + 3);
    assert_memory_equal(buffer.data, "x=42,000", 8);
    assert_string_equal(buffer.data + buffer.size - 6, "07,end");
    buffer_free(&buffer);
}

static void text_list__several__in_order_before_a_null(void **state)
{
    (void)state;
    struct text_list list = {0};
    struct error err;
    for (int i = 0; i < 100; i++)
        assert_ok(text_list_add(&list, &err, "%s-%d", "text", i), err);
    assert_int_equal(list.count, 100);
    assert_string_equal(list.texts[0], "text-0");
    assert_string_equal(list.texts[99], "text-99");
    assert_null(list.texts[100]);
    text_list_free(&list);
    assert_null(list.texts);
    assert_int_equal(list.count, 0);
    text_list_free(&list);
}

static void text_printf__format__new_string(void **state)
{
    (void)state;
    char *text;
    struct error err;
    assert_ok(text_printf(&text, &err, "%s/%03d-%s", "a", 7, "b.pov"), err);
    assert_string_equal(text, "a/007-b.pov");
    free(text);
}

#if !defined __SANITIZE_ADDRESS__ && !defined __SANITIZE_THREAD__
/* The sanitizers end the program when an allocation fails. */
static void buffer__more_than_memory__fails_and_stays(void **state)
{
    (void)state;
    struct buffer buffer = {0};
    struct error err = {""};
    assert_ok(buffer_add_text(&buffer, "kept", &err), err);
    char *data = buffer.data;
    size_t capacity = buffer.capacity;
    assert_int_equal(buffer_add(&buffer, "", (size_t)1 << 60, &err), RESULT_DATA);
    assert_true(err.text[0] != 0);
    assert_ptr_equal(buffer.data, data);
    assert_int_equal(buffer.capacity, capacity);
    assert_string_equal(buffer.data, "kept");
    buffer_free(&buffer);
}
#endif

static void assert_content(const char *path, const struct buffer *expected)
{
    size_t size;
    unsigned char *data = read_bytes(path, &size);
    assert_int_equal(size, expected->size);
    assert_memory_equal(data, expected->data, size);
    free(data);
}

static void file_write__any_size__every_byte(void **state)
{
    (void)state;
    static const size_t sizes[] = {0, 1, 65535, 65536, 65537, 300000};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        struct buffer buffer = {0};
        struct error err;
        for (size_t n = 0; n < sizes[i]; n++) {
            char c = (char)(n * 7 + n / 251);
            assert_ok(buffer_add(&buffer, &c, 1, &err), err);
        }
        assert_ok(file_write(in_scratch("file"), &buffer, &err), err);
        assert_content(in_scratch("file"), &buffer);
        buffer_free(&buffer);
    }
}

static void file_write__existing_longer_file__replaced(void **state)
{
    (void)state;
    struct buffer text = {0};
    struct error err;
    write_bytes(in_scratch("file"), "something longer", 16);
    assert_ok(buffer_add_text(&text, "short", &err), err);
    assert_ok(file_write(in_scratch("file"), &text, &err), err);
    assert_content(in_scratch("file"), &text);
    buffer_free(&text);
}

static void file_write__missing_folder_or_full_device__path_and_reason(void **state)
{
    (void)state;
    struct buffer text = {0};
    struct error err;
    assert_ok(buffer_add_text(&text, "text", &err), err);
    assert_int_equal(file_write(in_scratch("missing/file"), &text, &err), RESULT_DATA);
    assert_contains(err.text, in_scratch("missing/file"));
    assert_contains(err.text, "No such file");
    const char *device = full_device();
    assert_int_equal(file_write(device, &text, &err), RESULT_DATA);
    assert_contains(err.text, device);
    assert_contains(err.text, "No space left");
    buffer_free(&text);
}

static void memory__more_than_there_is__refused_with_the_figures(void **state)
{
    (void)state;
    struct error err;
    assert_int_equal(memory_check(1, &err), RESULT_OK);
    assert_int_equal(memory_check(1e18, &err), RESULT_DATA);
    assert_non_null(strstr(err.text, "out of memory: 1e+09 GB are needed, and "));
    assert_non_null(strstr(err.text, " GB are free; "));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory__more_than_there_is__refused_with_the_figures),
        cmocka_unit_test(buffer__many_small_pieces__all_there_with_a_nul),
        cmocka_unit_test(buffer__nothing_added__an_empty_string),
        cmocka_unit_test(buffer__nul_bytes__kept),
#if !defined __SANITIZE_ADDRESS__ && !defined __SANITIZE_THREAD__
        cmocka_unit_test(buffer__more_than_memory__fails_and_stays),
#endif
        cmocka_unit_test(buffer_printf__long_text__appended),
        cmocka_unit_test(text_printf__format__new_string),
        cmocka_unit_test(text_list__several__in_order_before_a_null),
        cmocka_unit_test(file_write__any_size__every_byte),
        cmocka_unit_test(file_write__existing_longer_file__replaced),
        cmocka_unit_test(file_write__missing_folder_or_full_device__path_and_reason),
    };
    return cmocka_run_group_tests_name("mem", tests, scratch_setup, scratch_teardown);
}
