-- In a headless Neovim with the lines of docs/editors.md: what the server says of the script that is open. Ends with 1 where something is missing.
local function fail(text)
  io.stdout:write(text .. "\n")
  vim.cmd("cquit 1")
end

local buffer = vim.api.nvim_get_current_buf()
if vim.bo[buffer].filetype ~= "windlass" then fail("the file type is " .. vim.bo[buffer].filetype) end
local found = vim.wait(20000, function() return #vim.diagnostic.get(buffer) > 0 end, 50)
if not found then fail("no diagnostic in 20 s") end
local first = vim.diagnostic.get(buffer)[1]
if first.lnum ~= 1 or not first.message:find("NO_SUCH_RECORD", 1, true) then fail("diagnostic: " .. vim.inspect(first)) end

local function ask(method, line, character, more)
  local parameters = { textDocument = vim.lsp.util.make_text_document_params(buffer), position = { line = line, character = character } }
  local answers = vim.lsp.buf_request_sync(buffer, method, vim.tbl_extend("force", parameters, more or {}), 20000)
  local _, answer = next(answers or {})
  if not answer or not answer.result then fail(method .. ": no answer: " .. vim.inspect(answers)) end
  return answer.result
end

local hover = vim.inspect(ask("textDocument/hover", 0, 2).contents)
if not hover:find("&DIMEN", 1, true) then fail("hover: " .. hover) end
local list = ask("textDocument/completion", 2, 3)
local words = {}
for _, item in ipairs(list.items or list) do words[#words + 1] = item.label end
if not vim.tbl_contains(words, "&EQUI") then fail("completion: " .. table.concat(words, " ")) end
io.stdout:write("diagnostic, hover and completion\n")
vim.cmd("qall!")
