-- ------------------------------------------------------------------ arithmetic of every Lua

-- 5.1 and 5.2 have libraries for bits, 5.3 and later operators that 5.2 cannot even read.
local bits = rawget(_G, "bit32") or rawget(_G, "bit")
if not bits then
    bits = load([[return {
        band = function(a, b) return a & b end,
        bxor = function(a, b) return a ~ b end,
        rshift = function(a, n) return a >> n end,
    }]])()
end
local band, bxor, rshift = bits.band, bits.bxor, bits.rshift
local WORD = 4294967296

local crc_table = {}
for index = 0, 255 do
    local value = index
    for _ = 1, 8 do
        local odd = value % 2 == 1
        value = rshift(value, 1) % WORD
        if odd then value = bxor(value, 0xEDB88320) % WORD end
    end
    crc_table[index] = value
end

local function crc32(text)
    local value = 0xFFFFFFFF
    for at = 1, #text do
        local index = bxor(band(value, 255), text:byte(at)) % 256
        value = bxor(rshift(value, 8), crc_table[index]) % WORD
    end
    return bxor(value, 0xFFFFFFFF) % WORD
end

local function little(text, at, size)
    local value = 0
    for offset = size - 1, 0, -1 do
        value = value * 256 + text:byte(at + offset)
    end
    return value
end

-- ------------------------------------------------------------------ fields

local proto = Proto("ebl", "EBL/" .. EBL.major .. " drive unit protocol")
local registered = {}

local function keep(field)
    registered[#registered + 1] = field
    return field
end

local MAKERS = {
    u8 = ProtoField.uint8, u16 = ProtoField.uint16, u32 = ProtoField.uint32,
    u64 = ProtoField.uint64, i16 = ProtoField.int16, i32 = ProtoField.int32,
}
local SIZES = { u8 = 1, u16 = 2, u32 = 4, u64 = 8, i16 = 2, i32 = 4, f32 = 4 }

local function number_field(abbr, name, kind, values, hexadecimal)
    if kind == "f32" then return keep(ProtoField.float(abbr, name)) end
    local shown = (hexadecimal and not values) and base.HEX or base.DEC
    return keep(MAKERS[kind](abbr, name, shown, values))
end

local function flag_fields(abbr, kind, names)
    local found = {}
    for bit, name in pairs(names) do
        local path = abbr .. "." .. name:lower()
        found[#found + 1] = keep(ProtoField.bool(path, name, 8 * SIZES[kind], nil, 2 ^ bit))
    end
    return found
end

local function register_layout(path, layout)
    for _, field in ipairs(layout) do
        local abbr = path .. "." .. field.name
        if field.tail == "text" then
            field.field = keep(ProtoField.string(abbr, field.name))
        elseif field.type == "bytes" or (field.type == "u8" and field.count > 1 and not field.enum) then
            field.field = keep(ProtoField.bytes(abbr, field.name))
        else
            local hexadecimal = field.flags or field.name:find("crc32", 1, true)
            local values = field.enum and EBL.enums[field.enum]
            field.field = number_field(abbr, field.name, field.type, values, hexadecimal)
            if field.flags then
                field.bits = flag_fields(abbr, field.type, EBL.flags[field.flags])
            end
        end
    end
end

local message_names, event_names, parameter_names, channel_names = {}, {}, {}, {}
for id, message in pairs(EBL.messages) do
    message_names[id] = message.name
    register_layout("ebl." .. message.name:lower() .. ".request", message.request)
    register_layout("ebl." .. message.name:lower() .. ".response", message.response)
end
for code, event in pairs(EBL.events) do
    event_names[code] = event.name
    register_layout("ebl.event." .. event.name:lower(), event.fields)
end
for id, parameter in pairs(EBL.parameters) do
    parameter_names[id] = parameter.name
    local abbr = "ebl.parameter." .. parameter.name
    if parameter.type == "text" then
        parameter.field = keep(ProtoField.string(abbr, parameter.name))
    else
        local values = parameter.enum and EBL.enums[parameter.enum]
        parameter.field = number_field(abbr, parameter.name, parameter.type, values)
    end
end
for id, channel in pairs(EBL.channels) do
    channel_names[id] = channel.name
    channel.field = keep(ProtoField.double("ebl.channel." .. channel.name, channel.name))
end

local KINDS = { [0] = "REQUEST", [1] = "RESPONSE", [2] = "STREAM", [3] = "ASYNC" }
local F = {
    frame = keep(ProtoField.bytes("ebl.frame", "Frame")),
    major = keep(ProtoField.uint8("ebl.major", "Major", base.DEC, nil, 0xE0)),
    kind = keep(ProtoField.uint8("ebl.kind", "Kind", base.DEC, KINDS, 0x18)),
    retransmit = keep(ProtoField.bool("ebl.retransmit", "Sent again", 8, nil, 0x02)),
    more = keep(ProtoField.bool("ebl.more", "More follows", 8, nil, 0x01)),
    tid = keep(ProtoField.uint8("ebl.tid", "Transaction id")),
    message = keep(ProtoField.uint16("ebl.message", "Message", base.HEX, message_names)),
    seq = keep(ProtoField.uint16("ebl.seq", "Sequence number")),
    stream_id = keep(ProtoField.uint8("ebl.stream.id", "Stream")),
    session = keep(ProtoField.uint8("ebl.bulk.session", "Log session")),
    status = keep(ProtoField.uint8("ebl.status", "Status", base.DEC, EBL.enums.status)),
    detail = keep(ProtoField.uint16("ebl.detail", "Detail")),
    rest = keep(ProtoField.bytes("ebl.rest", "More than this version knows")),
    crc = keep(ProtoField.uint32("ebl.crc", "Check value", base.HEX)),
    malformed = keep(ProtoField.string("ebl.malformed", "Malformed")),
    t0_us = keep(ProtoField.uint32("ebl.stream.t0_us", "Time of the first row")),
    rows = keep(ProtoField.uint8("ebl.stream.rows", "Rows")),
    epoch = keep(ProtoField.uint8("ebl.stream.epoch", "Epoch", base.DEC, nil, 0x07)),
    overrun = keep(ProtoField.bool("ebl.stream.overrun", "Frames before were lost", 8, nil, 0x08)),
    clip = keep(ProtoField.bool("ebl.stream.clip", "A value was clipped", 8, nil, 0x10)),
    encoding = keep(ProtoField.uint8("ebl.stream.encoding", "Encoding", base.DEC, nil, 0x60)),
    values = keep(ProtoField.bytes("ebl.stream.values", "Values of unknown channels")),
    missing = keep(ProtoField.string("ebl.channel.missing", "Missing")),
    event = keep(ProtoField.uint8("ebl.event.code", "Event", base.DEC, event_names)),
    t_us = keep(ProtoField.uint32("ebl.event.t_us", "Time")),
    offset = keep(ProtoField.uint32("ebl.bulk.offset", "Offset")),
    length = keep(ProtoField.uint16("ebl.bulk.length", "Length")),
    zero = keep(ProtoField.uint16("ebl.bulk.reserved", "Reserved")),
    data = keep(ProtoField.bytes("ebl.bulk.data", "Data")),
    parameter = keep(ProtoField.uint16("ebl.item", "Parameter", base.HEX, parameter_names)),
    index = keep(ProtoField.uint8("ebl.item.first", "First index")),
    count = keep(ProtoField.uint8("ebl.item.count", "Count")),
    unknown_item = keep(ProtoField.bytes("ebl.item.unknown", "Item of an unknown parameter")),
    channel = keep(ProtoField.uint8("ebl.channel", "Channel", base.DEC, channel_names)),
    violation = keep(ProtoField.uint8("ebl.violation", "Violation", base.DEC, EBL.enums.violation)),
}
proto.fields = registered

local FAULTS = {
    COBS = "The stuffing is broken, or the frame is shorter than any",
    CRC = "The check value is another: the frame was damaged",
    OVERFLOW = "Longer than any frame",
    CUT = "The packet ends inside a frame",
    LENGTH = "A field is missing",
    VERSION = "Another major version",
    RESERVED = "The reserved bit is set",
    UNKNOWN_MSG = "This message does not exist",
    SHAPE = "The rows or bytes do not fill the payload",
    ITEM = "An item is cut or of an unknown parameter",
}
local experts = {}
for code, words in pairs(FAULTS) do
    local group = code == "CRC" and expert.group.CHECKSUM or expert.group.MALFORMED
    experts[code] = ProtoExpert.new("ebl.expert." .. code:lower(), words, group, expert.severity.ERROR)
end
experts.REFUSED = ProtoExpert.new(
    "ebl.expert.refused", "The unit refuses", expert.group.RESPONSE_CODE, expert.severity.NOTE
)
local listed = {}
for _, one in pairs(experts) do listed[#listed + 1] = one end
proto.experts = listed

local function complain(tree, range, code)
    tree:add(F.malformed, range, code)
    tree:add_proto_expert_info(experts[code], FAULTS[code])
    return code
end

-- ------------------------------------------------------------------ what a line has said before

-- Asked: by transaction id, what an answer cannot be read without. Streams: channel ids by stream
-- and epoch. Packets are read in order once and then in any: notes keep what was known then.
local lines, notes = {}, {}

function proto.init()
    lines, notes = {}, {}
end

local function line_of(pinfo)
    local ends = { tostring(pinfo.src) .. "/" .. pinfo.src_port, tostring(pinfo.dst) .. "/" .. pinfo.dst_port }
    table.sort(ends)
    local key = table.concat(ends, "-")
    lines[key] = lines[key] or { asked = {}, streams = {} }
    return lines[key]
end

-- ------------------------------------------------------------------ values

local function add_unit(item, unit)
    if unit and unit ~= "" then item:append_text(" " .. unit) end
end

local function add_parameter(tree, parameter, range, index)
    local item
    if parameter.type == "text" then
        item = tree:add(parameter.field, range, range:string(ENC_UTF_8):match("^[^\0]*"))
    else
        item = tree:add_le(parameter.field, range)
    end
    add_unit(item, parameter.unit)
    if parameter.count > 1 then item:append_text(" [" .. index .. "]") end
end

local function add_items(tree, tvb, at)
    while at < tvb:len() do
        if tvb:len() - at < 4 then return complain(tree, tvb(at), "ITEM") end
        local parameter = EBL.parameters[tvb(at, 2):le_uint()]
        local first, count = tvb(at + 2, 1):uint(), tvb(at + 3, 1):uint()
        local size = parameter and count * parameter.length
        if not parameter or tvb:len() - at - 4 < size then
            tree:add(F.unknown_item, tvb(at))
            return complain(tree, tvb(at), "ITEM")
        end
        local item = tree:add_le(F.parameter, tvb(at, 2))
        item:add(F.index, tvb(at + 2, 1))
        item:add(F.count, tvb(at + 3, 1))
        for step = 0, count - 1 do
            local range = tvb(at + 4 + step * parameter.length, parameter.length)
            add_parameter(item, parameter, range, first + step)
        end
        at = at + 4 + size
    end
end

-- Every element of the image that lies whole in the piece that starts at `offset` of it.
local function add_image(tree, tvb, at, offset)
    local stop = offset + tvb:len() - at
    for _, id in ipairs(EBL.image_order) do
        local parameter = EBL.parameters[id]
        for index = 0, parameter.count - 1 do
            local begin = parameter.offset + index * parameter.length
            if begin >= offset and begin + parameter.length <= stop then
                add_parameter(tree, parameter, tvb(at + begin - offset, parameter.length), index)
            end
        end
    end
end

local function add_row(tree, tvb, at, channels)
    for position, id in ipairs(channels) do
        local range = tvb(at + 2 * position - 2, 2)
        local channel, count = EBL.channels[id], range:le_int()
        if not channel then
            tree:add(F.values, range)
        elseif count == EBL.missing then
            tree:add(F.missing, range, channel.name)
        else
            add_unit(tree:add(channel.field, range, count * channel.scale), channel.unit)
        end
    end
end

local function ids_in(tvb, at)
    local found = {}
    for place = at, tvb:len() - 1 do found[#found + 1] = tvb(place, 1):uint() end
    return found
end

local TAILS = {
    items = function(tree, tvb, at) return add_items(tree, tvb, at) end,
    channel_ids = function(tree, tvb, at)
        for place = at, tvb:len() - 1 do tree:add(F.channel, tvb(place, 1)) end
    end,
    parameter_ids = function(tree, tvb, at)
        for place = at, tvb:len() - 2, 2 do tree:add_le(F.parameter, tvb(place, 2)) end
    end,
    asked_row = function(tree, tvb, at, note)
        if note.channels and tvb:len() - at >= 2 * #note.channels then
            add_row(tree, tvb, at, note.channels)
        end
    end,
    full_row = function(tree, tvb, at)
        if tvb:len() - at >= 2 * #EBL.channel_order then add_row(tree, tvb, at, EBL.channel_order) end
    end,
    image = function(tree, tvb, at, note)
        if note.offset then add_image(tree, tvb, at, note.offset) end
    end,
}

local function add_tail(tree, field, tvb, at, note)
    if at >= tvb:len() then return end
    if field.tail == "text" then
        tree:add(field.field, tvb(at), tvb(at):string(ENC_UTF_8))
        return
    end
    local item = tree:add(field.field, tvb(at))
    local read = TAILS[field.tail]
    if read then read(item, tvb, at, note) end
end

-- Adds the fields of a layout from `at` on; LENGTH when one is missing.
local function add_fields(tree, layout, tvb, at, note)
    for _, field in ipairs(layout) do
        if field.type == "bytes" then
            add_tail(tree, field, tvb, at, note)
            return
        end
        local size = SIZES[field.type]
        -- A peer that does not know the high half of a number ends before it.
        if field.high and tvb:len() - at < size then return end
        if tvb:len() - at < size * field.count then return complain(tree, tvb(), "LENGTH") end
        if field.type == "u8" and field.count > 1 and not field.enum then
            tree:add(field.field, tvb(at, field.count))
        else
            for index = 0, field.count - 1 do
                local range = tvb(at + index * size, size)
                local item = tree:add_le(field.field, range)
                add_unit(item, field.unit)
                for _, flag in ipairs(field.bits or {}) do item:add_le(flag, range) end
            end
        end
        at = at + size * field.count
    end
    if at < tvb:len() then tree:add(F.rest, tvb(at)) end
end

-- ------------------------------------------------------------------ the kinds of frames

local function add_request(tree, tvb, note, line)
    local id, tid = tvb(2, 2):le_uint(), tvb(1, 1):uint()
    tree:add(F.tid, tvb(1, 1))
    tree:add_le(F.message, tvb(2, 2))
    local message = EBL.messages[id]
    if not message then return complain(tree, tvb(2, 2), "UNKNOWN_MSG") end
    local fault = add_fields(tree, message.request, tvb, 4, note)
    if fault == "LENGTH" or not line then return fault end
    local asked = { id = id }
    if message.name == "STR_SUBSCRIBE" then
        asked.stream, asked.channels = tvb(4, 1):uint(), ids_in(tvb, 10)
    elseif message.name == "STR_SNAPSHOT" then
        asked.channels = ids_in(tvb, 4)
    elseif message.name == "CFG_READ" then
        asked.offset = tvb(5, 2):le_uint()
    end
    line.asked[tid] = asked
    return fault
end

local function add_refusal(tree, tvb)
    if tvb:len() < 7 then return complain(tree, tvb(), "LENGTH") end
    local name = EBL.enums.status[tvb(4, 1):uint()]
    local detail = tree:add_le(F.detail, tvb(5, 2))
    detail:append_text(" (" .. (EBL.details[name] or "no meaning") .. ")")
    if name ~= "PENDING" then
        tree:add_proto_expert_info(experts.REFUSED, name or "A status of a newer version")
    end
    if name ~= "INVALID_CONFIG" then
        if tvb:len() > 7 then tree:add(F.rest, tvb(7)) end
        return
    end
    for at = 7, tvb:len() - 4, 4 do
        local item = tree:add_le(F.parameter, tvb(at, 2))
        item:add(F.index, tvb(at + 2, 1))
        item:add(F.violation, tvb(at + 3, 1))
    end
end

local function add_response(tree, tvb, note, line)
    tree:add(F.tid, tvb(1, 1))
    tree:add_le(F.message, tvb(2, 2))
    if tvb:len() < 5 then return complain(tree, tvb(), "LENGTH") end
    tree:add(F.status, tvb(4, 1))
    if tvb(4, 1):uint() ~= 0 then return add_refusal(tree, tvb) end
    local id = tvb(2, 2):le_uint()
    local message = EBL.messages[id]
    if not message then return complain(tree, tvb(2, 2), "UNKNOWN_MSG") end
    if line then
        local asked = line.asked[tvb(1, 1):uint()]
        if asked and asked.id == id then
            note.channels, note.offset = asked.channels, asked.offset
            if asked.stream and tvb:len() >= 11 then
                line.streams[asked.stream .. "/" .. tvb(10, 1):uint()] = asked.channels
            end
        end
    end
    return add_fields(tree, message.response, tvb, 5, note)
end

local function add_stream(tree, tvb, note, line)
    tree:add(F.stream_id, tvb(1, 1))
    tree:add_le(F.seq, tvb(2, 2))
    if tvb:len() < 10 then return complain(tree, tvb(), "LENGTH") end
    add_unit(tree:add_le(F.t0_us, tvb(4, 4)), "us")
    tree:add(F.rows, tvb(8, 1))
    for _, name in ipairs({ "epoch", "overrun", "clip", "encoding" }) do tree:add(F[name], tvb(9, 1)) end
    local flags, rows, size = tvb(9, 1):uint(), tvb(8, 1):uint(), tvb:len() - 10
    if line then note.channels = line.streams[tvb(1, 1):uint() .. "/" .. flags % 8] end
    local width = note.channels and #note.channels or (rows > 0 and math.floor(size / (2 * rows)) or 0)
    if size ~= 2 * rows * width or band(flags, 0x60) ~= 0 then return complain(tree, tvb(), "SHAPE") end
    if not note.channels then
        if size > 0 then tree:add(F.values, tvb(10)) end
        return
    end
    for row = 0, rows - 1 do
        if width > 0 then
            local range = tvb(10 + 2 * width * row, 2 * width)
            add_row(tree:add(range, "Row " .. row), tvb, 10 + 2 * width * row, note.channels)
        end
    end
end

local function add_bulk(tree, tvb)
    tree:add(F.session, tvb(1, 1))
    tree:add_le(F.seq, tvb(2, 2))
    if tvb(1, 1):uint() > EBL.session_max then return complain(tree, tvb(1, 1), "UNKNOWN_MSG") end
    if tvb:len() < 12 then return complain(tree, tvb(), "LENGTH") end
    tree:add_le(F.offset, tvb(4, 4))
    tree:add_le(F.length, tvb(8, 2))
    tree:add_le(F.zero, tvb(10, 2))
    if tvb:len() > 12 then tree:add(F.data, tvb(12)) end
    local length = tvb(8, 2):le_uint()
    if length == 0 or length ~= tvb:len() - 12 then return complain(tree, tvb(), "SHAPE") end
end

local function add_event(tree, tvb, note)
    tree:add_le(F.seq, tvb(2, 2))
    if tvb:len() < 9 then return complain(tree, tvb(), "LENGTH") end
    tree:add(F.event, tvb(4, 1))
    add_unit(tree:add_le(F.t_us, tvb(5, 4)), "us")
    local event = EBL.events[tvb(4, 1):uint()]
    if event then return add_fields(tree, event.fields, tvb, 9, note) end
    if tvb:len() > 9 then tree:add(F.rest, tvb(9)) end
end

local function summary(tvb)
    local kind, tag, word = math.floor(tvb(0, 1):uint() / 8) % 4, tvb(1, 1):uint(), tvb(2, 2):le_uint()
    if kind == 2 then return "stream " .. tag .. " #" .. word end
    if kind == 3 and tag > 0 then return "log session " .. tag .. " #" .. word end
    if kind == 3 then
        local code = tvb:len() > 4 and tvb(4, 1):uint()
        return "event " .. (event_names[code] or tostring(code))
    end
    local name = message_names[word] or string.format("0x%04x", word)
    if kind == 0 then return name .. " ? #" .. tag end
    local status = tvb:len() > 4 and tvb(4, 1):uint()
    return name .. " = " .. (EBL.enums.status[status] or tostring(status)) .. " #" .. tag
end

-- One frame, decoded and without its check value.
local function add_frame(tree, tvb, note, line)
    if tvb:len() < 4 then return complain(tree, tvb(), "LENGTH") end
    local first = tvb(0, 1):uint()
    for _, name in ipairs({ "major", "kind", "retransmit", "more" }) do tree:add(F[name], tvb(0, 1)) end
    if math.floor(first / 32) ~= EBL.major then return complain(tree, tvb(0, 1), "VERSION") end
    if band(first, 4) ~= 0 then return complain(tree, tvb(0, 1), "RESERVED") end
    local kind = math.floor(first / 8) % 4
    if kind == 0 then return add_request(tree, tvb, note, line) end
    if kind == 1 then return add_response(tree, tvb, note, line) end
    if kind == 2 then return add_stream(tree, tvb, note, line) end
    if tvb(1, 1):uint() == 0 then return add_event(tree, tvb, note) end
    return add_bulk(tree, tvb)
end

-- ------------------------------------------------------------------ from the wire

-- The decoded bytes of a stretch between two delimiters, or nil and what is wrong.
local function unstuffed(text)
    local parts, at, length, cut = {}, 1, 0, false
    while at <= #text do
        local code = text:byte(at)
        local run = text:sub(at + 1, at + code - 1)
        cut = #run < code - 1
        parts[#parts + 1] = run
        length = length + #run
        at = at + code
        if code < 255 and at <= #text then
            parts[#parts + 1] = "\0"
            length = length + 1
        end
    end
    if length > EBL.mtu then return nil, "OVERFLOW" end
    if cut or length < EBL.frame_length_min then return nil, "COBS" end
    local plain = table.concat(parts)
    if crc32(plain:sub(1, -5)) ~= little(plain, #plain - 3, 4) then return nil, "CRC" end
    return plain
end

local function add_stretch(range, pinfo, root)
    local tree = root:add(proto, range)
    local plain, fault = unstuffed(range:raw())
    if not plain then
        tree:append_text(", " .. FAULTS[fault])
        tree:add(F.frame, range)
        complain(tree, range, fault)
        return "damaged (" .. fault .. ")"
    end
    local whole = ByteArray.new(plain, true):tvb("EBL frame")
    local frame = whole(0, whole:len() - 4):tvb()
    -- What was said before counts only when packets are read in their order, the first time.
    local key = pinfo.number .. ":" .. range:offset()
    notes[key] = notes[key] or {}
    add_frame(tree, frame, notes[key], not pinfo.visited and line_of(pinfo) or nil)
    tree:add_le(F.crc, whole(whole:len() - 4, 4))
    local words = summary(frame)
    tree:append_text(", " .. words)
    return words
end

-- How much of a stretch may wait for its end before it can be no frame any more.
local PENDING_MAX = EBL.mtu + math.floor(EBL.mtu / 254) + 2

local function dissect(tvb, pinfo, root, may_wait)
    pinfo.cols.protocol = "EBL"
    local text, words, begin = tvb():raw(), {}, nil
    for at = 1, #text do
        if text:byte(at) ~= 0 then
            begin = begin or at
        elseif begin then
            words[#words + 1] = add_stretch(tvb(begin - 1, at - begin), pinfo, root)
            begin = nil
        end
    end
    pinfo.cols.info = table.concat(words, ", ")
    if not begin then return tvb:len() end
    local tail = tvb(begin - 1)
    if may_wait and tail:len() <= PENDING_MAX then
        pinfo.desegment_offset = begin - 1
        pinfo.desegment_len = DESEGMENT_ONE_MORE_SEGMENT
        return tvb:len()
    end
    complain(root:add(proto, tail), tail, may_wait and "OVERFLOW" or "CUT")
    return tvb:len()
end

function proto.dissector(tvb, pinfo, root)
    return dissect(tvb, pinfo, root, true)
end

-- A packet of DLT_USER0 is what the port gave at once: whole frames with their delimiters.
local serial = Proto("ebl_serial", "EBL on a serial line")
function serial.dissector(tvb, pinfo, root)
    return dissect(tvb, pinfo, root, false)
end

local tcp_port = 0
proto.prefs.port = Pref.uint("TCP port", EBL.tcp_port, "Where a unit listens; 0 for none")
local function listen()
    local tcp = DissectorTable.get("tcp.port")
    if tcp_port > 0 then tcp:remove(tcp_port, proto) end
    tcp_port = proto.prefs.port
    if tcp_port > 0 then tcp:add(tcp_port, proto) end
end
proto.prefs_changed = listen
listen()
DissectorTable.get("wtap_encap"):add(wtap.USER0, serial)
