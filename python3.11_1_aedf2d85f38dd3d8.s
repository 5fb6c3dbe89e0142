	.att_syntax
	.file	"1"
	.section	.ltext,"axl",@progbits
	.globl	nothing
	.prefalign	4, .Lfunc_end0, nop
	.type	nothing,@function
nothing:
	endbr64
	pushq	%rbp
	movq	%rsp, %rbp
	andq	$-8, %rsp
	movq	(%rdi), %rax
	movl	$1, (%rax)
	movq	%rbp, %rsp
	popq	%rbp
	retq
.Lfunc_end0:
	.size	nothing, .Lfunc_end0-nothing

	.ident	"Intel(R) oneAPI DPC++/C++ Compiler 2026.2.0 (2026.2.0.20261001)"
	.section	".note.GNU-stack","",@progbits
