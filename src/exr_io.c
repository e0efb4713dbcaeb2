/* OpenEXR files as named planes of floats, by OpenEXRCore.
 *
 * Both directions go through memory: OpenEXRCore reads and writes at offsets, which a pipe can't do, and what it writes
 * then goes out through output_file. What OpenEXRCore 3.1 decodes wrongly or not at all (B44, DWA) is refused.
 */
#include "exr_io.h"

#include "bands.h"
#include "input_file.h"
#include "mem.h"
#include "output_file.h"

#include <assert.h>
#include <openexr.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* No compression goes beyond deflate's 1032:1, and a half becomes a float. */
static const double max_bytes_per_byte = 2 * 1032;

/* zlib's level 2 takes 0.6 of the default level's time, for a passes file 6 % larger. */
enum { MAX_CHANNELS = 1024, SHORT_NAME_LENGTH = 31, ZIP_LEVEL = 2 };

static const char eye_name[] = "povgloss:eye";
static const char view_angle_name[] = "povgloss:viewAngle";
static const char working_gamma_name[] = "povgloss:workingGamma";
static const char version_name[] = "povgloss:version";

/* OpenEXRCore's own handler prints; the result codes say enough. */
static void ignore_message(exr_const_context_t context, exr_result_t code, const char *message)
{
    (void)context, (void)code, (void)message;
}

/* What OpenEXRCore couldn't have. Its result codes don't always tell, and EXR_ERR_OUT_OF_MEMORY may be damage. */
static atomic_size_t bytes_lacking;

static void *allocate(size_t size)
{
    void *block = malloc(size);
    if (!block)
        bytes_lacking = size;
    return block;
}

static exr_context_initializer_t begin_context(void *user_data)
{
    exr_context_initializer_t initializer = EXR_DEFAULT_CONTEXT_INITIALIZER;
    initializer.error_handler_fn = ignore_message;
    initializer.alloc_fn = allocate;
    initializer.free_fn = free;
    initializer.user_data = user_data;
    bytes_lacking = 0;
    return initializer;
}

static int64_t memory_read(exr_const_context_t context, void *user_data, void *buffer, uint64_t size, uint64_t offset,
                           exr_stream_error_func_ptr_t error_callback)
{
    (void)context, (void)error_callback;
    const struct input_file *file = user_data;
    if (offset >= file->size)
        return 0;
    if (size > file->size - offset)
        size = file->size - offset;
    memcpy(buffer, file->data + offset, size);
    return (int64_t)size;
}

static int64_t memory_size(exr_const_context_t context, void *user_data)
{
    (void)context;
    const struct input_file *file = user_data;
    return (int64_t)file->size;
}

/* A part of a file that is being read. */
struct part {
    exr_context_t context;
    const char *name; /* of the file, for messages */
    int index;
    bool tiled;
    int left, top, width, height;      /* the data window */
    int32_t block_width, block_height; /* of a tile, or of a chunk of scanlines */
    const exr_attr_chlist_t *channels;
    int first_plane; /* of the image: that of the part's first channel */
    int x, y;        /* of the image: where the part's first pixel goes */
};

/* A file that is being read. */
struct reader {
    exr_context_t context;
    const char *name; /* for messages */
    size_t file_size; /* bytes */
    struct part *parts;
    int part_count;
    int width, height, channels; /* of the image */
};

static enum result damaged(const char *name, exr_result_t code, struct error *err)
{
    if (bytes_lacking > 0)
        return error_memory(err, (double)bytes_lacking);
    return error_set(err, RESULT_DATA, "%s: the OpenEXR file is damaged or cut short (%s)", name,
                     exr_get_default_error_message(code));
}

static enum result check_compression(const struct part *part, struct error *err)
{
    exr_compression_t compression;
    exr_result_t code = exr_get_compression(part->context, part->index, &compression);
    if (code)
        return damaged(part->name, code, err);
    const char *refused = NULL;
    switch (compression) {
    case EXR_COMPRESSION_NONE:
    case EXR_COMPRESSION_RLE:
    case EXR_COMPRESSION_ZIPS:
    case EXR_COMPRESSION_ZIP:
    case EXR_COMPRESSION_PIZ:
    case EXR_COMPRESSION_PXR24: break;
    case EXR_COMPRESSION_B44: refused = "B44"; break;
    case EXR_COMPRESSION_B44A: refused = "B44A"; break;
    case EXR_COMPRESSION_DWAA: refused = "DWAA"; break;
    case EXR_COMPRESSION_DWAB: refused = "DWAB"; break;
    default: refused = "of an unknown kind";
    }
    if (refused)
        return error_set(err, RESULT_DATA,
                         "%s: its compression is %s, which is not supported; convert it: "
                         "oiiotool in.exr --compression zip -o out.exr",
                         part->name, refused);
    return RESULT_OK;
}

static enum result check_storage(struct part *part, struct error *err)
{
    exr_storage_t storage;
    exr_result_t code = exr_get_storage(part->context, part->index, &storage);
    if (code)
        return damaged(part->name, code, err);
    if (storage == EXR_STORAGE_DEEP_SCANLINE || storage == EXR_STORAGE_DEEP_TILED)
        return error_set(err, RESULT_DATA,
                         "%s: holds deep data; flatten it: oiiotool in.exr -a --flatten --compression zip -o out.exr",
                         part->name);
    part->tiled = storage == EXR_STORAGE_TILED;
    return RESULT_OK;
}

static enum result check_size(const char *name, int64_t width, int64_t height, struct error *err)
{
    if (width < 1 || height < 1 || width > IMAGE_MAX_SIDE || height > IMAGE_MAX_SIDE)
        return error_set(err, RESULT_DATA, "%s: an image of %lld x %lld pixels: each side must be from 1 to %d", name,
                         (long long)width, (long long)height, IMAGE_MAX_SIDE);
    return RESULT_OK;
}

/* Size, place and kind of the blocks. */
static enum result read_geometry(struct part *part, struct error *err)
{
    exr_attr_box2i_t window;
    exr_result_t code = exr_get_data_window(part->context, part->index, &window);
    if (code)
        return damaged(part->name, code, err);
    int64_t width = (int64_t)window.max.x - window.min.x + 1, height = (int64_t)window.max.y - window.min.y + 1;
    enum result result = check_size(part->name, width, height, err);
    if (result)
        return result;
    part->left = window.min.x;
    part->top = window.min.y;
    part->width = (int)width;
    part->height = (int)height;
    part->block_width = part->width;
    code = part->tiled
               ? exr_get_tile_sizes(part->context, part->index, 0, 0, &part->block_width, &part->block_height)
               : exr_get_scanlines_per_chunk(part->context, part->index, &part->block_height);
    if (!code && (part->block_width < 1 || part->block_height < 1))
        code = EXR_ERR_INVALID_ATTR;
    return code ? damaged(part->name, code, err) : RESULT_OK;
}

static enum result check_channels(struct part *part, struct error *err)
{
    exr_result_t code = exr_get_channels(part->context, part->index, &part->channels);
    if (code)
        return damaged(part->name, code, err);
    for (int i = 0; i < part->channels->num_channels; i++) {
        const exr_attr_chlist_entry_t *entry = &part->channels->entries[i];
        if (entry->x_sampling != 1 || entry->y_sampling != 1)
            return error_set(err, RESULT_DATA,
                             "%s: channel %s is subsampled (%d x %d), which is not supported; "
                             "write it at full resolution",
                             part->name, entry->name.str, entry->x_sampling, entry->y_sampling);
        if (entry->name.length < 1 || entry->name.length >= EXR_NAME_SIZE)
            return damaged(part->name, EXR_ERR_NAME_TOO_LONG, err);
    }
    return RESULT_OK;
}

static enum result read_part_headers(struct reader *reader, struct error *err)
{
    exr_result_t code = exr_get_count(reader->context, &reader->part_count);
    if (!code && reader->part_count < 1)
        code = EXR_ERR_MISSING_REQ_ATTR;
    if (code)
        return damaged(reader->name, code, err);
    reader->parts = calloc((size_t)reader->part_count, sizeof *reader->parts);
    if (!reader->parts)
        return error_memory(err, (double)reader->part_count * (double)sizeof *reader->parts);
    enum result result = RESULT_OK;
    for (int i = 0; i < reader->part_count && !result; i++) {
        struct part *part = &reader->parts[i];
        *part = (struct part){.context = reader->context, .name = reader->name, .index = i};
        result = check_storage(part, err);
        if (!result)
            result = check_compression(part, err);
        if (!result)
            result = read_geometry(part, err);
        if (!result)
            result = check_channels(part, err);
    }
    return result;
}

static int min_int(int a, int b)
{
    return a < b ? a : b;
}

static int max_int(int a, int b)
{
    return a > b ? a : b;
}

/* The image is what holds the data windows of all parts. Its memory, and the picture's, is checked before anything is
 * allocated. */
static enum result place_parts(struct reader *reader, struct image_window *window, struct error *err)
{
    int left = reader->parts[0].left, top = reader->parts[0].top;
    int64_t right = 0, bottom = 0, channels = 0;
    for (int i = 0; i < reader->part_count; i++) {
        left = min_int(left, reader->parts[i].left);
        top = min_int(top, reader->parts[i].top);
        channels += reader->parts[i].channels->num_channels;
    }
    for (int i = 0; i < reader->part_count; i++) {
        struct part *part = &reader->parts[i];
        int64_t x = (int64_t)part->left - left, y = (int64_t)part->top - top;
        right = x + part->width > right ? x + part->width : right;
        bottom = y + part->height > bottom ? y + part->height : bottom;
        part->x = (int)x;
        part->y = (int)y;
    }
    enum result result = check_size(reader->name, right, bottom, err);
    if (result)
        return result;
    if (channels < 1 || channels > MAX_CHANNELS)
        return error_set(err, RESULT_DATA, "%s: has %lld channels; from 1 to %d are read", reader->name,
                         (long long)channels, MAX_CHANNELS);
    reader->width = (int)right;
    reader->height = (int)bottom;
    reader->channels = (int)channels;

    exr_attr_box2i_t display;
    exr_result_t code = exr_get_display_window(reader->context, 0, &display);
    if (code)
        return damaged(reader->name, code, err);
    int64_t display_width = (int64_t)display.max.x - display.min.x + 1;
    int64_t display_height = (int64_t)display.max.y - display.min.y + 1;
    result = check_size(reader->name, display_width, display_height, err);
    if (result)
        return result;
    *window = (struct image_window){.left = (int64_t)display.min.x - left,
                                    .top = (int64_t)display.min.y - top,
                                    .width = (int)display_width,
                                    .height = (int)display_height};
    double stored_bytes = 0;
    for (const struct part *part = reader->parts; part < reader->parts + reader->part_count; part++)
        stored_bytes += (double)sizeof(float) * part->width * part->height * part->channels->num_channels;
    if (stored_bytes > max_bytes_per_byte * (double)reader->file_size)
        return error_set(err, RESULT_DATA,
                         "%s: the OpenEXR file is damaged or cut short (%d x %d pixels of %d channels can't be in %zu "
                         "bytes)",
                         reader->name, reader->width, reader->height, reader->channels, reader->file_size);
    double data_bytes = (double)sizeof(float) * reader->width * reader->height * reader->channels;
    double display_bytes = (double)sizeof(float) * window->width * window->height * 3;
    if (data_bytes + display_bytes > input_memory_limit())
        return error_set(err, RESULT_DATA,
                         "%s: %d x %d pixels of %d channels take %.1f GB, more than half of this machine's memory; "
                         "write fewer channels or a smaller image",
                         reader->name, max_int(reader->width, window->width), max_int(reader->height, window->height),
                         reader->channels, (data_bytes + display_bytes) / 1e9);
    return RESULT_OK;
}

/* The part's name, which its channels go by; NULL where there is none, or one that only counts parts (OpenImageIO's
 * "subimage00"). */
static const char *layer_of_part(const struct reader *reader, const struct part *part)
{
    static const char numbered[] = "subimage";
    const char *name;
    if (reader->part_count < 2 || exr_get_name(reader->context, part->index, &name) || !*name)
        return NULL;
    size_t length = strlen(numbered);
    if (!strncmp(name, numbered, length) && !name[length + strspn(name + length, "0123456789")])
        return NULL;
    return name;
}

static enum result read_names(const struct reader *reader, struct exr_contents *contents, struct error *err)
{
    contents->names = calloc((size_t)reader->channels, sizeof *contents->names);
    if (!contents->names)
        return error_memory(err, (double)reader->channels * (double)sizeof *contents->names);
    int plane = 0;
    for (int i = 0; i < reader->part_count; i++) {
        struct part *part = &reader->parts[i];
        const char *layer = layer_of_part(reader, part);
        size_t length = layer ? strlen(layer) : 0;
        part->first_plane = plane;
        for (int j = 0; j < part->channels->num_channels; j++, plane++) {
            const char *name = part->channels->entries[j].name.str;
            bool bare = layer && (strncmp(name, layer, length) || name[length] != '.');
            char *joined = contents->names[plane];
            if (snprintf(joined, EXR_NAME_SIZE, "%s%s%s", bare ? layer : "", bare ? "." : "", name) >= EXR_NAME_SIZE)
                return error_set(err, RESULT_DATA, "%s: the name of part %d and that of its channel %s are too long",
                                 reader->name, i + 1, name);
            for (int k = 0; k < plane; k++)
                if (!strcmp(contents->names[k], joined))
                    return error_set(err, RESULT_DATA,
                                     "%s: has two channels %s, the second in part %d; name the parts, or keep one: "
                                     "oiiotool in.exr --subimage %d -o out.exr",
                                     reader->name, joined, i + 1, i);
        }
    }
    return RESULT_OK;
}

/* The chunk whose first pixel is (x, y) of the part. OpenEXRCore 3.1 takes an uncompressed chunk of any size, and what
 * is missing of it would be whatever the memory held. */
static exr_result_t find_chunk(const struct part *part, int x, int y, exr_chunk_info_t *chunk)
{
    exr_result_t code = part->tiled ? exr_read_tile_chunk_info(part->context, part->index, x / part->block_width,
                                                               y / part->block_height, 0, 0, chunk)
                                    : exr_read_scanline_chunk_info(part->context, part->index, part->top + y, chunk);
    if (code)
        return code;
    if (chunk->width < 1 || chunk->height < 1 || chunk->width > part->width - x || chunk->height > part->height - y ||
        (chunk->compression == EXR_COMPRESSION_NONE && chunk->packed_size != chunk->unpacked_size))
        return EXR_ERR_CORRUPT_CHUNK;
    return EXR_ERR_SUCCESS;
}

static int plane_of(const struct part *part, const char *channel)
{
    for (int i = 0; i < part->channels->num_channels; i++)
        if (!strcmp(part->channels->entries[i].name.str, channel))
            return part->first_plane + i;
    assert(!"the pipeline has the channels of the header");
    return -1;
}

/* Decodes one block into the image; the pipeline is empty, or was used for the block to the left. */
static exr_result_t decode_block(const struct part *part, const struct image *image, int x, int y,
                                 exr_decode_pipeline_t *pipeline)
{
    exr_chunk_info_t chunk;
    exr_result_t code = find_chunk(part, x, y, &chunk);
    bool first = !pipeline->channels;
    if (!code)
        code = first ? exr_decoding_initialize(part->context, part->index, &chunk, pipeline)
                     : exr_decoding_update(part->context, part->index, &chunk, pipeline);
    if (code)
        return code;
    /* The pipeline sorts its channels by name, and forgets the pointers with every chunk. */
    for (int i = 0; i < pipeline->channel_count; i++) {
        exr_coding_channel_info_t *to = &pipeline->channels[i];
        float *row = image_row(image, plane_of(part, to->channel_name), part->y + y);
        to->decode_to_ptr = (uint8_t *)(row + part->x + x);
        to->user_data_type = EXR_PIXEL_FLOAT;
        to->user_bytes_per_element = sizeof(float);
        to->user_pixel_stride = sizeof(float);
        to->user_line_stride = (int32_t)(image->stride * sizeof(float));
    }
    if (first)
        code = exr_decoding_choose_default_routines(part->context, part->index, pipeline);
    return code ? code : exr_decoding_run(part->context, part->index, pipeline);
}

struct decoding {
    const struct part *part;
    const struct image *image;
    atomic_int code; /* of a block that failed */
};

static void decode_rows(void *context, int first, int end)
{
    (void)end;
    struct decoding *decoding = context;
    const struct part *part = decoding->part;
    exr_decode_pipeline_t pipeline = EXR_DECODE_PIPELINE_INITIALIZER;
    exr_result_t code = EXR_ERR_SUCCESS;
    for (int x = 0; x < part->width && !code; x += part->block_width)
        code = decode_block(part, decoding->image, x, first, &pipeline);
    exr_decoding_destroy(part->context, &pipeline);
    if (code)
        decoding->code = code;
}

static enum result read_pixels(const struct reader *reader, const struct image *image, struct error *err)
{
    enum result result = RESULT_OK;
    for (int i = 0; i < reader->part_count && !result; i++) {
        const struct part *part = &reader->parts[i];
        struct decoding decoding = {.part = part, .image = image};
        result = bands_run(part->height, part->block_height, 0, decode_rows, &decoding, err);
        if (!result && decoding.code)
            result = damaged(reader->name, (exr_result_t)decoding.code, err);
    }
    return result;
}

/* Before any memory is taken for the image: a short file that claims to be huge ends here. */
static enum result check_chunks(const struct reader *reader, struct error *err)
{
    exr_chunk_info_t chunk;
    exr_result_t code = EXR_ERR_SUCCESS;
    for (int i = 0; i < reader->part_count; i++) {
        const struct part *part = &reader->parts[i];
        for (int y = 0; y < part->height && !code; y += part->block_height)
            for (int x = 0; x < part->width && !code; x += part->block_width)
                code = find_chunk(part, x, y, &chunk);
    }
    return code ? damaged(reader->name, code, err) : RESULT_OK;
}

/* An attribute that is there with another type is refused: leaving it out would silently change the picture. */
static enum result attribute_result(const struct part *part, const char *attribute, const char *type, exr_result_t code,
                                    bool *found, struct error *err)
{
    *found = code == EXR_ERR_SUCCESS;
    if (!code || code == EXR_ERR_NO_ATTR_BY_NAME)
        return RESULT_OK;
    return error_set(err, RESULT_DATA, "%s: attribute %s must be a %s", part->name, attribute, type);
}

static enum result read_float_attribute(const struct part *part, const char *attribute, float *value,
                                        struct error *err)
{
    bool found;
    float stored = 0;
    exr_result_t code = exr_attr_get_float(part->context, part->index, attribute, &stored);
    double wide;
    if (code == EXR_ERR_ATTR_TYPE_MISMATCH && !exr_attr_get_double(part->context, part->index, attribute, &wide)) {
        stored = (float)wide;
        code = EXR_ERR_SUCCESS;
    }
    enum result result = attribute_result(part, attribute, "float", code, &found, err);
    if (found)
        *value = stored;
    return result;
}

/* Those of the part; what it lacks stays as it is. */
static enum result read_attributes(const struct part *part, struct exr_attributes *attributes, struct error *err)
{
    bool found;
    exr_attr_v3f_t eye;
    exr_result_t code = exr_attr_get_v3f(part->context, part->index, eye_name, &eye);
    enum result result = attribute_result(part, eye_name, "v3f", code, &found, err);
    if (result)
        return result;
    if (found) {
        attributes->has_eye = true;
        memcpy(attributes->eye, eye.arr, sizeof attributes->eye);
    }
    result = read_float_attribute(part, view_angle_name, &attributes->view_angle, err);
    if (result)
        return result;
    return read_float_attribute(part, working_gamma_name, &attributes->working_gamma, err);
}

static enum result read_contents(struct reader *reader, struct exr_contents *contents, struct error *err)
{
    enum result result = read_part_headers(reader, err);
    if (!result)
        result = place_parts(reader, &contents->window, err);
    if (!result)
        result = read_names(reader, contents, err);
    for (int i = reader->part_count - 1; i >= 0 && !result; i--)
        result = read_attributes(&reader->parts[i], &contents->attributes, err);
    if (!result)
        result = check_chunks(reader, err);
    /* Whoever asks for the file holds its pixels twice at least. */
    if (!result)
        result = memory_check(2.0 * (double)sizeof(float) * reader->width * reader->height * reader->channels, err);
    if (!result)
        result = image_alloc(&contents->image, reader->width, reader->height, reader->channels, err);
    if (!result)
        result = read_pixels(reader, &contents->image, err);
    return result;
}

enum result exr_read(const char *path, struct exr_contents *contents, struct error *err)
{
    static const unsigned char magic[4] = {0x76, 0x2f, 0x31, 0x01};
    struct input_file file;
    struct reader reader = {.name = input_file_name(path)};
    *contents = (struct exr_contents){0};
    enum result result = input_file_read(path, &file, err);
    if (result)
        return result;

    reader.file_size = file.size;
    if (file.size < sizeof magic || memcmp(file.data, magic, sizeof magic) != 0) {
        result = error_set(err, RESULT_DATA, "%s: %s", reader.name,
                           file.size == 0 ? "is empty" : "not an OpenEXR file");
        goto out;
    }
    exr_context_initializer_t initializer = begin_context(&file);
    initializer.read_fn = memory_read;
    initializer.size_fn = memory_size;
    initializer.max_image_width = initializer.max_image_height = IMAGE_MAX_SIDE;
    initializer.max_tile_width = initializer.max_tile_height = IMAGE_MAX_SIDE;
    initializer.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    exr_result_t code = exr_start_read(&reader.context, reader.name, &initializer);
    if (bytes_lacking > 0) {
        result = error_memory(err, (double)bytes_lacking);
        goto out;
    }
    if (code) {
        result = error_set(err, RESULT_DATA,
                           "%s: the OpenEXR header is damaged, cut short or of an image of more than %d pixels a side "
                           "(%s)",
                           reader.name, IMAGE_MAX_SIDE, exr_get_default_error_message(code));
        goto out;
    }
    result = read_contents(&reader, contents, err);
out:
    exr_finish(&reader.context);
    free(reader.parts);
    input_file_free(&file);
    if (result)
        exr_contents_free(contents);
    return result;
}

void exr_contents_free(struct exr_contents *contents)
{
    image_free(&contents->image);
    free(contents->names);
    *contents = (struct exr_contents){0};
}

int exr_find(const struct exr_contents *contents, const char *name)
{
    for (int i = 0; i < contents->image.channels; i++)
        if (strcmp(contents->names[i], name) == 0)
            return i;
    return -1;
}

/* The bytes of a file that is being written. */
struct memory_file {
    unsigned char *data;
    size_t size, capacity;
};

static int64_t memory_write(exr_const_context_t context, void *user_data, const void *buffer, uint64_t size,
                            uint64_t offset, exr_stream_error_func_ptr_t error_callback)
{
    (void)context, (void)error_callback;
    struct memory_file *file = user_data;
    size_t end = offset + size;
    if (end > file->capacity) {
        size_t capacity = end > 2 * file->capacity ? end : 2 * file->capacity;
        unsigned char *larger = realloc(file->data, capacity);
        if (!larger) {
            bytes_lacking = capacity;
            return -1;
        }
        file->data = larger;
        file->capacity = capacity;
    }
    if (offset > file->size)
        memset(file->data + file->size, 0, offset - file->size);
    memcpy(file->data + offset, buffer, size);
    if (end > file->size)
        file->size = end;
    return (int64_t)size;
}

static exr_result_t write_attributes(exr_context_t context, int part, const struct exr_attributes *attributes)
{
    exr_result_t code = exr_attr_set_string(context, part, version_name, POVGLOSS_VERSION);
    if (!attributes)
        return code;
    if (!code && attributes->has_eye) {
        exr_attr_v3f_t eye;
        memcpy(eye.arr, attributes->eye, sizeof eye.arr);
        code = exr_attr_set_v3f(context, part, eye_name, &eye);
    }
    if (!code && attributes->view_angle != 0)
        code = exr_attr_set_float(context, part, view_angle_name, attributes->view_angle);
    if (!code && attributes->working_gamma != 0)
        code = exr_attr_set_float(context, part, working_gamma_name, attributes->working_gamma);
    return code;
}

static exr_result_t write_header(exr_context_t context, int part, const struct exr_channel *channels,
                                 int channel_count, const struct exr_attributes *attributes)
{
    const struct image *image = channels[0].image;
    struct image_window shown = {.width = image->width, .height = image->height};
    if (attributes && attributes->window.width > 0)
        shown = attributes->window;
    const exr_attr_box2i_t display = {.max = {.x = shown.width - 1, .y = shown.height - 1}};
    const int32_t left = (int32_t)-shown.left, top = (int32_t)-shown.top;
    const exr_attr_box2i_t data = {.min = {.x = left, .y = top},
                                   .max = {.x = left + image->width - 1, .y = top + image->height - 1}};
    const exr_attr_v2f_t centre = {.x = 0, .y = 0};
    exr_result_t code = exr_initialize_required_attr(context, part, &display, &data, 1, &centre, 1,
                                                     EXR_LINEORDER_INCREASING_Y, EXR_COMPRESSION_ZIP);
    for (int i = 0; i < channel_count && !code; i++)
        code = exr_add_channel(context, part, channels[i].name, EXR_PIXEL_FLOAT, EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    if (!code)
        code = write_attributes(context, part, attributes);
    return code ? code : exr_write_header(context);
}

static const struct exr_channel *channel_named(const struct exr_channel *channels, int channel_count,
                                               const char *name)
{
    for (int i = 0; i < channel_count; i++)
        if (strcmp(channels[i].name, name) == 0)
            return &channels[i];
    assert(!"the pipeline has the channels of the header");
    return NULL;
}

/* Chunks are compressed by several threads, and written one after another from the top. */
struct encoding {
    exr_context_t context;
    int part;
    const struct exr_channel *channels;
    int channel_count;
    pthread_mutex_t lock;
    pthread_cond_t turn_changed;
    int top;           /* of the data window */
    int turn;          /* the first row of the chunk that is to be written next */
    exr_result_t code; /* of a chunk that failed: no more are written */
};

/* Before the chunk is written. One that deflate left as long as it was is written as it was, which a reader takes it
 * for by its size; OpenEXRCore to 3.4.7 doesn't (its issue 2306). */
static exr_result_t wait_for_turn(exr_encode_pipeline_t *pipeline)
{
    struct encoding *encoding = pipeline->encoding_user_data;
    if (pipeline->compressed_bytes == pipeline->packed_bytes)
        memcpy(pipeline->compressed_buffer, pipeline->packed_buffer, pipeline->packed_bytes);
    pthread_mutex_lock(&encoding->lock);
    while (encoding->turn < pipeline->chunk.start_y - encoding->top && !encoding->code)
        pthread_cond_wait(&encoding->turn_changed, &encoding->lock);
    exr_result_t code = encoding->code;
    pthread_mutex_unlock(&encoding->lock);
    return code;
}

static void pass_turn(struct encoding *encoding, int next, exr_result_t code)
{
    pthread_mutex_lock(&encoding->lock);
    encoding->turn = next;
    if (!encoding->code)
        encoding->code = code;
    pthread_cond_broadcast(&encoding->turn_changed);
    pthread_mutex_unlock(&encoding->lock);
}

static exr_result_t encode_chunk(struct encoding *encoding, int y, exr_encode_pipeline_t *pipeline)
{
    exr_chunk_info_t chunk;
    exr_result_t code = exr_write_scanline_chunk_info(encoding->context, encoding->part, encoding->top + y, &chunk);
    if (!code)
        code = exr_encoding_initialize(encoding->context, encoding->part, &chunk, pipeline);
    if (code)
        return code;
    /* The pipeline sorts its channels by name. */
    for (int i = 0; i < pipeline->channel_count; i++) {
        exr_coding_channel_info_t *to = &pipeline->channels[i];
        const struct exr_channel *from =
            channel_named(encoding->channels, encoding->channel_count, to->channel_name);
        to->encode_from_ptr = (const uint8_t *)image_row(from->image, from->channel, y);
        to->user_data_type = EXR_PIXEL_FLOAT;
        to->user_bytes_per_element = sizeof(float);
        to->user_pixel_stride = sizeof(float);
        to->user_line_stride = (int32_t)(from->image->stride * sizeof(float));
    }
    code = exr_encoding_choose_default_routines(encoding->context, encoding->part, pipeline);
    if (code)
        return code;
    pipeline->encoding_user_data = encoding;
    pipeline->yield_until_ready_fn = wait_for_turn;
    return exr_encoding_run(encoding->context, encoding->part, pipeline);
}

static void encode_rows(void *context, int first, int end)
{
    struct encoding *encoding = context;
    exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
    exr_result_t code = encode_chunk(encoding, first, &pipeline);
    exr_encoding_destroy(encoding->context, &pipeline);
    pass_turn(encoding, end, code);
}

static exr_result_t begin_file(exr_context_t context, int *part, const struct exr_channel *channels,
                               int channel_count, const struct exr_attributes *attributes)
{
    bool long_names = false;
    for (int i = 0; i < channel_count; i++)
        long_names |= strlen(channels[i].name) > SHORT_NAME_LENGTH;
    exr_result_t code = EXR_ERR_SUCCESS;
    if (long_names)
        code = exr_set_longname_support(context, 1);
    if (!code)
        code = exr_add_part(context, NULL, EXR_STORAGE_SCANLINE, part);
    if (!code)
        code = exr_set_zip_compression_level(context, *part, ZIP_LEVEL);
    return code ? code : write_header(context, *part, channels, channel_count, attributes);
}

/* The whole file, in memory. */
static enum result encode(const char *name, struct memory_file *file, const struct exr_channel *channels,
                          int channel_count, const struct exr_attributes *attributes, struct error *err)
{
    exr_context_initializer_t initializer = begin_context(file);
    initializer.write_fn = memory_write;
    struct encoding encoding = {.channels = channels,
                                .channel_count = channel_count,
                                .top = attributes && attributes->window.width > 0 ? (int)-attributes->window.top : 0,
                                .lock = PTHREAD_MUTEX_INITIALIZER,
                                .turn_changed = PTHREAD_COND_INITIALIZER};
    int32_t lines = 0;
    exr_result_t code = exr_start_write(&encoding.context, "memory", EXR_WRITE_FILE_DIRECTLY, &initializer);
    if (!code)
        code = begin_file(encoding.context, &encoding.part, channels, channel_count, attributes);
    if (!code)
        code = exr_get_scanlines_per_chunk(encoding.context, encoding.part, &lines);
    enum result result = RESULT_OK;
    if (!code) {
        result = bands_run(channels[0].image->height, lines, 0, encode_rows, &encoding, err);
        code = encoding.code;
    }
    exr_result_t finished = exr_finish(&encoding.context);
    if (!code)
        code = finished;
    /* OpenEXRCore calls every failure of zlib a corrupt chunk: compressing fails only for lack of memory. */
    if (code && !result && (bytes_lacking > 0 || code == EXR_ERR_OUT_OF_MEMORY || code == EXR_ERR_CORRUPT_CHUNK))
        result = error_memory(err, (double)bytes_lacking);
    else if (code && !result)
        result = error_set(err, RESULT_DATA, "%s: the OpenEXR file cannot be made (%s)", name,
                           exr_get_default_error_message(code));
    return result;
}

enum result exr_write(const char *path, const struct exr_channel *channels, int channel_count,
                      const struct exr_attributes *attributes, struct error *err)
{
    assert(channel_count > 0);
    for (int i = 0; i < channel_count; i++)
        assert(channels[i].image->width == channels[0].image->width &&
               channels[i].image->height == channels[0].image->height &&
               channels[i].channel < channels[i].image->channels);

    /* Opened first: a folder that can't be written to is told before the work of compressing. */
    struct output_file output;
    struct memory_file file = {0};
    enum result result = output_file_open(&output, path, err);
    if (result)
        return result;
    result = encode(output_file_name(path), &file, channels, channel_count, attributes, err);
    if (result)
        goto out;
    result = output_file_write(&output, file.data, file.size, err);
    if (result)
        goto out;
    result = output_file_commit(&output, err);
out:
    output_file_abort(&output);
    free(file.data);
    return result;
}
