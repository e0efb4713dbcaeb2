/* The places on a contact sheet, and the few letters of its labels. */
#include "sheet.h"

#include <math.h>
#include <string.h>

enum { GAP_PX = 8, GLYPH_WIDTH = 5, GLYPH_HEIGHT = 7 };

static const float paper = 0.02f, ink = 0.8f;

/* Each row of a glyph is 5 bits, the leftmost one is 16. */
static const struct {
    char letter;
    unsigned char rows[GLYPH_HEIGHT];
} glyphs[] = {
    {'0', {14, 17, 19, 21, 25, 17, 14}}, {'1', {4, 12, 4, 4, 4, 4, 14}},     {'2', {14, 17, 1, 2, 4, 8, 31}},
    {'3', {31, 2, 4, 2, 1, 17, 14}},     {'4', {2, 6, 10, 18, 31, 2, 2}},    {'5', {31, 16, 30, 1, 1, 17, 14}},
    {'6', {6, 8, 16, 30, 17, 17, 14}},   {'7', {31, 1, 2, 4, 8, 8, 8}},      {'8', {14, 17, 17, 14, 17, 17, 14}},
    {'9', {14, 17, 17, 15, 1, 2, 12}},   {'e', {0, 0, 14, 17, 31, 16, 14}},  {'f', {6, 9, 8, 28, 8, 8, 8}},
    {'i', {4, 0, 12, 4, 4, 4, 14}},      {'n', {0, 0, 22, 25, 17, 17, 17}},  {'p', {0, 0, 30, 17, 30, 16, 16}},
    {'.', {0, 0, 0, 0, 0, 12, 12}},      {'+', {0, 4, 4, 31, 4, 4, 0}},      {'-', {0, 0, 0, 31, 0, 0, 0}},
    {'=', {0, 0, 31, 0, 31, 0, 0}},
};

static int columns(int count)
{
    return (int)ceil(sqrt(count));
}

/* Pixels of the picture for each of a glyph. */
static int label_scale(int width)
{
    return width < 320 ? 1 : width / 160;
}

static int label_height(int width)
{
    return GLYPH_HEIGHT * label_scale(width) + GAP_PX;
}

/* Of the cells, whose pictures are width x height pixels, without the sheet's left and upper gap. */
static void cell_size(int width, int height, int *cell_width, int *cell_height)
{
    *cell_width = width + GAP_PX;
    *cell_height = height + label_height(width) + GAP_PX;
}

enum result sheet_alloc(struct image *sheet, int count, int width, int height, struct error *err)
{
    int across = columns(count), down = (count + across - 1) / across, cell_width, cell_height;
    cell_size(width, height, &cell_width, &cell_height);
    double wide = GAP_PX + (double)across * cell_width, high = GAP_PX + (double)down * cell_height;
    *sheet = (struct image){0};
    if (wide > IMAGE_MAX_SIDE || high > IMAGE_MAX_SIDE)
        return error_set(err, RESULT_DATA,
                         "a sheet of %d pictures would be %.0f x %.0f pixels, more than %d on a side: name fewer exponents",
                         count, wide, high, IMAGE_MAX_SIDE);
    enum result result = image_alloc(sheet, (int)wide, (int)high, 3, err);
    for (int channel = 0; !result && channel < 3; channel++)
        for (int y = 0; y < sheet->height; y++)
            for (int x = 0; x < sheet->width; x++)
                image_row(sheet, channel, y)[x] = paper;
    return result;
}

static void put_glyph(struct image *sheet, int left, int top, int scale, char letter)
{
    size_t glyph = 0, count = sizeof glyphs / sizeof *glyphs;
    while (glyph < count && glyphs[glyph].letter != letter)
        glyph++;
    for (int y = 0; glyph < count && y < GLYPH_HEIGHT * scale; y++)
        for (int x = 0; x < GLYPH_WIDTH * scale; x++)
            for (int channel = 0; channel < 3; channel++)
                if (glyphs[glyph].rows[y / scale] >> (GLYPH_WIDTH - 1 - x / scale) & 1)
                    image_row(sheet, channel, top + y)[left + x] = ink;
}

void sheet_put(struct image *sheet, int count, int index, const struct image *picture, const char *label)
{
    int across = columns(count), cell_width, cell_height;
    cell_size(picture->width, picture->height, &cell_width, &cell_height);
    int left = GAP_PX + index % across * cell_width, top = GAP_PX + index / across * cell_height;
    int scale = label_scale(picture->width), advance = (GLYPH_WIDTH + 1) * scale;
    for (int i = 0; label[i] && (i + 1) * advance <= picture->width; i++)
        put_glyph(sheet, left + i * advance, top, scale, label[i]);
    top += label_height(picture->width);
    for (int channel = 0; channel < 3; channel++)
        for (int y = 0; y < picture->height; y++)
            memcpy(image_row(sheet, channel, top + y) + left, image_row(picture, channel, y),
                   (size_t)picture->width * sizeof(float));
}
