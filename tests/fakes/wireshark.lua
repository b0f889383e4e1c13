-- What a dissector sees of Wireshark, and no more: fields are recorded instead of shown.
-- A range outside its buffer is an error, as it is there.

local recorded = {}

base = { DEC = 1, HEX = 2 }
ENC_UTF_8 = 2
wtap = { USER0 = 45 }
DESEGMENT_ONE_MORE_SEGMENT = 0x0fffffff
expert = {
    group = { CHECKSUM = 1, MALFORMED = 2, RESPONSE_CODE = 3 },
    severity = { ERROR = 1, NOTE = 2 },
}

Pref = { uint = function(_, default) return default end }
ProtoExpert = { new = function(abbr) return { abbr = abbr } end }

ProtoField = {}
for _, kind in ipairs({
    "uint8", "uint16", "uint32", "uint64", "int16", "int32", "float", "double", "bytes", "string",
}) do
    ProtoField[kind] = function(abbr, name, _, _, mask)
        assert(type(abbr) == "string" and type(name) == "string")
        return { abbr = abbr, kind = kind, mask = mask }
    end
end
ProtoField.bool = function(abbr, name, width, _, mask)
    assert(type(name) == "string" and width % 8 == 0)
    return { abbr = abbr, kind = "bool", mask = mask }
end

local function buffer_of(text)
    local buffer = {}
    local function range_of(at, length)
        at = at or 0
        length = length or #text - at
        assert(at >= 0 and length >= 0 and at + length <= #text, "outside the buffer")
        local range = {}
        local function little()
            local value = 0
            for place = at + length, at + 1, -1 do value = value * 256 + text:byte(place) end
            return value
        end
        function range:string(encoding)
            assert(encoding == ENC_UTF_8)
            return self:raw()
        end
        function range:raw() return text:sub(at + 1, at + length) end
        function range:len() return length end
        function range:offset() return at end
        function range:le_uint() return little() end
        function range:uint()
            assert(length == 1, "this protocol has little-endian numbers only")
            return little()
        end
        function range:le_int()
            local value, half = little(), 2 ^ (8 * length - 1)
            return value >= half and value - 2 * half or value
        end
        function range:tvb() return buffer_of(self:raw()) end
        return range
    end
    function buffer:len() return #text end
    return setmetatable(buffer, { __call = function(_, at, length) return range_of(at, length) end })
end

ByteArray = {
    new = function(text, raw)
        assert(raw == true)
        return { tvb = function() return buffer_of(text) end }
    end,
}

local function tree_of()
    local tree = {}
    local function add(field, range, value)
        if field.abbr then
            recorded[#recorded + 1] =
                { field.abbr, field.kind, field.mask or 0, range:raw(), value }
        end
        return tree_of()
    end
    function tree:add(...) return add(...) end
    function tree:add_le(...) return add(...) end
    function tree:append_text(text) assert(type(text) == "string") end
    function tree:add_proto_expert_info(one, text) assert(one.abbr and type(text) == "string") end
    return tree
end

local dissectors = {}
DissectorTable = {
    get = function(name)
        return {
            add = function(_, _, proto) dissectors[name] = proto end,
            remove = function() end,
        }
    end,
}

function Proto(name, words)
    assert(#name > 0 and #words > 0)
    return { prefs = {}, init = function() end }
end

-- Shows one packet to the dissector of `where` ("wtap_encap" or "tcp.port"). Gives what it
-- recorded, and from which byte on it waits for more; -1 for nothing.
function show(where, text, number, source, destination)
    recorded = {}
    local pinfo = {
        number = number, visited = false, cols = {},
        src = source, src_port = 1, dst = destination, dst_port = 1,
    }
    dissectors[where].dissector(buffer_of(text), pinfo, tree_of())
    local waits = pinfo.desegment_len and pinfo.desegment_offset or -1
    return recorded, waits, pinfo.cols.info
end
