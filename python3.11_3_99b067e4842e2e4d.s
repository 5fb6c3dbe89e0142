	.att_syntax
	.file	"3"
	.section	.rodata,"a",@progbits
	.p2align	6, 0x0
.LCPI0_0:
	.long	0
	.long	2
	.long	4
	.long	6
	.long	8
	.long	10
	.long	12
	.long	14
	.long	16
	.long	18
	.long	20
	.long	22
	.long	24
	.long	26
	.long	28
	.long	30
	.section	.lrodata.cst4,"aMl",@progbits,4
	.p2align	2, 0x0
.LCPI0_1:
	.long	1
.LCPI0_2:
	.long	0x3f800000
.LCPI0_3:
	.long	0x45800800
.LCPI0_4:
	.long	0x7fffffff
.LCPI0_5:
	.long	0x27800000
.LCPI0_6:
	.long	0x57800000
.LCPI0_7:
	.long	0x35000000
.LCPI0_8:
	.long	0x3e99999a
.LCPI0_9:
	.long	0x7f800000
.LCPI0_10:
	.long	0x80000000
.LCPI0_11:
	.long	0x3ecccccd
.LCPI0_12:
	.long	0x3ffae148
.LCPI0_13:
	.long	1041865114
.LCPI0_14:
	.long	3189348762
.LCPI0_15:
	.long	0x399d4952
.LCPI0_16:
	.long	100
.LCPI0_17:
	.long	2
	.section	.ltext,"axl",@progbits
	.globl	camera
	.prefalign	4, .Lfunc_end0, nop
	.type	camera,@function
camera:
	endbr64
	pushq	%rbp
	movq	%rsp, %rbp
	pushq	%r15
	pushq	%r14
	pushq	%r13
	pushq	%r12
	pushq	%rbx
	andq	$-64, %rsp
	subq	$448, %rsp
	movq	(%rsi), %r9
	movq	208(%rdi), %rax
	movq	8(%rsi), %rsi
	movq	200(%rdi), %rcx
	movslq	28(%rdi), %r8
	movslq	24(%rdi), %rdx
	imulq	%rax, %rsi
	addq	48(%rdi), %rsi
	imulq	%rcx, %r9
	addq	40(%rdi), %r9
	movq	%rdx, (%rsp)
	addq	%rsi, %rax
	movq	%r9, 16(%rsp)
	cmpq	%r8, %rax
	cmovgeq	%r8, %rax
	addq	%r9, %rcx
	cmpq	%rdx, %rcx
	movq	%rax, 24(%rsp)
	cmovgeq	%rdx, %rcx
	movq	%rcx, %rdx
	subq	%r9, %rdx
	testq	%rdx, %rdx
	jle	.LBB0_40
	movq	24(%rsp), %rax
	subq	%rsi, %rax
	testq	%rax, %rax
	jle	.LBB0_40
	movabsq	$9223372036854775792, %r10
	movq	%r8, 40(%rsp)
	movq	(%rdi), %r8
	movq	8(%rdi), %r9
	movq	16(%rdi), %rdi
	movabsq	$.LCPI0_10, %r11
	movabsq	$.LCPI0_13, %r15
	movabsq	$.LCPI0_15, %r12
	movabsq	$.LCPI0_14, %r13
	movq	%rsi, 8(%rsp)
	movq	%rdx, 48(%rsp)
	andq	%rdx, %r10
	addq	16(%rsp), %r10
	cmpq	$16, %rdx
	jae	.LBB0_3
.LBB0_11:
	testb	$15, 48(%rsp)
	movq	8(%rsp), %rdx
	movq	40(%rsp), %rax
	je	.LBB0_40
	vcvtsi2ssl	(%rsp), %xmm15, %xmm0
	movabsq	$.LCPI0_3, %rsi
	movabsq	$.LCPI0_2, %rbx
	vxorps	%xmm3, %xmm3, %xmm3
	vmovss	(%rsi), %xmm4
	movabsq	$.LCPI0_6, %rsi
	vmovss	(%rbx), %xmm2
	movabsq	$.LCPI0_4, %rbx
	vmovss	(%rsi), %xmm6
	movabsq	$.LCPI0_5, %rsi
	vbroadcastss	(%rbx), %xmm5
	vbroadcastss	(%rbx), %xmm8
	movabsq	$.LCPI0_8, %rbx
	vmovss	(%rsi), %xmm7
	movabsq	$.LCPI0_7, %rsi
	vmovss	(%rbx), %xmm10
	vmovss	(%rsi), %xmm9
	movabsq	$.LCPI0_9, %rsi
	vmovss	(%rsi), %xmm11
	vcvtsi2ss	%eax, %xmm15, %xmm1
	jmp	.LBB0_13
	.p2align	4
.LBB0_39:
	movq	8(%rsp), %rdx
	incq	%rdx
	cmpq	24(%rsp), %rdx
	je	.LBB0_40
.LBB0_13:
	leal	1(%rdx,%rdx), %eax
	movq	%rdx, 8(%rsp)
	vcvtsi2ss	%eax, %xmm12, %xmm12
	movq	(%rsp), %rax
	imull	%edx, %eax
	movq	%r10, %rdx
	vsubss	%xmm12, %xmm1, %xmm12
	vdivss	%xmm1, %xmm12, %xmm12
	jmp	.LBB0_14
.LBB0_30:
	xorl	%ebx, %ebx
.LBB0_36:
	leal	(%rbx,%rsi,4), %esi
.LBB0_37:
	vmovaps	%xmm16, %xmm19
.LBB0_38:
	vaddss	%xmm19, %xmm13, %xmm13
	leal	(%rax,%rdx), %ebx
	incq	%rdx
	movslq	%ebx, %rbx
	vmovss	%xmm13, (%r9,%rbx,4)
	movl	%esi, (%rdi,%rbx,4)
	cmpq	%rcx, %rdx
	je	.LBB0_39
.LBB0_14:
	leal	1(%rdx,%rdx), %esi
	vmovss	(%r8), %xmm18
	vmovss	4(%r8), %xmm20
	vmovss	8(%r8), %xmm16
	vpxord	%xmm31, %xmm31, %xmm31
	vcvtsi2ss	%esi, %xmm31, %xmm13
	vsubss	%xmm0, %xmm13, %xmm13
	vdivss	%xmm0, %xmm13, %xmm13
	vmulss	24(%r8), %xmm13, %xmm14
	vmulss	28(%r8), %xmm13, %xmm15
	vmulss	32(%r8), %xmm13, %xmm13
	vaddss	20(%r8), %xmm13, %xmm17
	vaddss	12(%r8), %xmm14, %xmm14
	vmulss	36(%r8), %xmm12, %xmm13
	vaddss	16(%r8), %xmm15, %xmm15
	vaddss	%xmm13, %xmm14, %xmm14
	vmulss	40(%r8), %xmm12, %xmm13
	vaddss	%xmm13, %xmm15, %xmm13
	vmulss	44(%r8), %xmm12, %xmm15
	vmulss	%xmm13, %xmm13, %xmm19
	vaddss	%xmm15, %xmm17, %xmm15
	vmulss	%xmm14, %xmm14, %xmm17
	vaddss	%xmm19, %xmm17, %xmm17
	vmulss	%xmm15, %xmm15, %xmm19
	vaddss	%xmm17, %xmm19, %xmm17
	vmovaps	%xmm6, %xmm19
	vsqrtss	%xmm17, %xmm17, %xmm17
	vdivss	%xmm17, %xmm2, %xmm21
	vmulss	%xmm21, %xmm14, %xmm14
	vandps	%xmm5, %xmm14, %xmm17
	vucomiss	%xmm17, %xmm7
	ja	.LBB0_16
	vdivss	%xmm14, %xmm2, %xmm19
.LBB0_16:
	vmulss	%xmm21, %xmm13, %xmm17
	vsubss	%xmm18, %xmm3, %xmm13
	vmulss	%xmm21, %xmm15, %xmm15
	vsubss	%xmm20, %xmm3, %xmm21
	vsubss	%xmm16, %xmm3, %xmm22
	vmulss	%xmm4, %xmm14, %xmm24
	vmulss	%xmm14, %xmm13, %xmm13
	vmulss	%xmm17, %xmm21, %xmm21
	vsubss	%xmm14, %xmm24, %xmm25
	vaddss	%xmm21, %xmm13, %xmm13
	vmulss	%xmm15, %xmm22, %xmm21
	vsubss	%xmm25, %xmm24, %xmm24
	vaddss	%xmm13, %xmm21, %xmm13
	vsubss	%xmm24, %xmm14, %xmm25
	vmulss	%xmm4, %xmm13, %xmm22
	vmulss	%xmm13, %xmm14, %xmm21
	vsubss	%xmm13, %xmm22, %xmm23
	vsubss	%xmm23, %xmm22, %xmm23
	vmulss	%xmm23, %xmm24, %xmm26
	vsubss	%xmm23, %xmm13, %xmm22
	vmulss	%xmm23, %xmm25, %xmm27
	vsubss	%xmm26, %xmm21, %xmm26
	vmulss	%xmm22, %xmm24, %xmm24
	vmulss	%xmm22, %xmm25, %xmm25
	vsubss	%xmm27, %xmm26, %xmm26
	vsubss	%xmm24, %xmm26, %xmm24
	vsubss	%xmm24, %xmm25, %xmm24
	vaddss	%xmm21, %xmm18, %xmm25
	vsubss	%xmm18, %xmm25, %xmm26
	vsubss	%xmm26, %xmm25, %xmm27
	vsubss	%xmm26, %xmm21, %xmm21
	vsubss	%xmm27, %xmm18, %xmm18
	vaddss	%xmm18, %xmm21, %xmm18
	vaddss	%xmm24, %xmm18, %xmm18
	vmovaps	%xmm6, %xmm24
	vaddss	%xmm18, %xmm25, %xmm18
	vandps	%xmm8, %xmm18, %xmm21
	vaddss	%xmm2, %xmm21, %xmm21
	vmulss	%xmm9, %xmm21, %xmm25
	vandps	%xmm8, %xmm17, %xmm21
	vucomiss	%xmm21, %xmm7
	ja	.LBB0_18
	vdivss	%xmm17, %xmm2, %xmm24
.LBB0_18:
	vmulss	%xmm4, %xmm17, %xmm26
	vmulss	%xmm13, %xmm17, %xmm21
	vsubss	%xmm17, %xmm26, %xmm27
	vaddss	%xmm21, %xmm20, %xmm30
	vsubss	%xmm27, %xmm26, %xmm26
	vmulss	%xmm23, %xmm26, %xmm28
	vsubss	%xmm26, %xmm17, %xmm27
	vmulss	%xmm22, %xmm26, %xmm26
	vmulss	%xmm23, %xmm27, %xmm29
	vsubss	%xmm28, %xmm21, %xmm28
	vmulss	%xmm22, %xmm27, %xmm27
	vsubss	%xmm29, %xmm28, %xmm28
	vsubss	%xmm26, %xmm28, %xmm26
	vsubss	%xmm20, %xmm30, %xmm28
	vsubss	%xmm28, %xmm30, %xmm29
	vsubss	%xmm28, %xmm21, %xmm21
	vsubss	%xmm26, %xmm27, %xmm26
	vsubss	%xmm29, %xmm20, %xmm20
	vaddss	%xmm20, %xmm21, %xmm20
	vaddss	%xmm26, %xmm20, %xmm20
	vaddss	%xmm20, %xmm30, %xmm21
	vandps	%xmm8, %xmm21, %xmm20
	vaddss	%xmm2, %xmm20, %xmm20
	vmulss	%xmm9, %xmm20, %xmm26
	vandps	%xmm8, %xmm15, %xmm20
	vucomiss	%xmm20, %xmm7
	vmovaps	%xmm6, %xmm20
	ja	.LBB0_20
	vdivss	%xmm15, %xmm2, %xmm20
.LBB0_20:
	vmulss	%xmm4, %xmm15, %xmm28
	vmulss	%xmm13, %xmm15, %xmm27
	xorl	%esi, %esi
	vsubss	%xmm15, %xmm28, %xmm29
	vsubss	%xmm29, %xmm28, %xmm28
	vsubss	%xmm28, %xmm15, %xmm29
	vmulss	%xmm23, %xmm28, %xmm30
	vmulss	%xmm22, %xmm28, %xmm28
	vmulss	%xmm23, %xmm29, %xmm23
	vmulss	%xmm22, %xmm29, %xmm22
	vsubss	%xmm30, %xmm27, %xmm29
	vsubss	%xmm23, %xmm29, %xmm23
	vsubss	%xmm28, %xmm23, %xmm23
	vsubss	%xmm23, %xmm22, %xmm22
	vaddss	%xmm27, %xmm16, %xmm23
	vsubss	%xmm16, %xmm23, %xmm28
	vsubss	%xmm28, %xmm23, %xmm29
	vsubss	%xmm28, %xmm27, %xmm27
	vsubss	%xmm29, %xmm16, %xmm16
	vaddss	%xmm16, %xmm27, %xmm16
	vaddss	%xmm22, %xmm16, %xmm16
	vaddss	%xmm16, %xmm23, %xmm22
	vsubss	%xmm18, %xmm3, %xmm16
	vaddss	%xmm2, %xmm25, %xmm23
	vaddss	%xmm2, %xmm26, %xmm25
	vmulss	%xmm16, %xmm19, %xmm16
	vandps	%xmm8, %xmm19, %xmm19
	vmulss	%xmm23, %xmm19, %xmm19
	vsubss	%xmm19, %xmm16, %xmm23
	vaddss	%xmm16, %xmm19, %xmm16
	vsubss	%xmm21, %xmm3, %xmm19
	vmulss	%xmm19, %xmm24, %xmm19
	vandps	%xmm8, %xmm24, %xmm24
	vmulss	%xmm25, %xmm24, %xmm24
	vsubss	%xmm24, %xmm19, %xmm25
	vaddss	%xmm19, %xmm24, %xmm19
	vandps	%xmm8, %xmm22, %xmm24
	vaddss	%xmm10, %xmm24, %xmm24
	vminss	%xmm19, %xmm16, %xmm16
	vsubss	%xmm22, %xmm3, %xmm19
	vmaxss	%xmm25, %xmm23, %xmm23
	vmulss	%xmm9, %xmm24, %xmm24
	vmulss	%xmm20, %xmm19, %xmm19
	vandps	%xmm8, %xmm20, %xmm20
	vaddss	%xmm10, %xmm24, %xmm24
	vmulss	%xmm24, %xmm20, %xmm20
	vsubss	%xmm20, %xmm19, %xmm24
	vaddss	%xmm20, %xmm19, %xmm19
	vsubss	%xmm13, %xmm11, %xmm20
	vminss	%xmm19, %xmm16, %xmm16
	vsubss	%xmm13, %xmm3, %xmm19
	vmaxss	%xmm24, %xmm23, %xmm23
	vminss	%xmm20, %xmm16, %xmm16
	vmaxss	%xmm19, %xmm23, %xmm19
	vucomiss	%xmm19, %xmm16
	jb	.LBB0_38
	vmulss	%xmm18, %xmm14, %xmm25
	vmulss	%xmm21, %xmm17, %xmm24
	vmulss	%xmm22, %xmm15, %xmm23
	vaddss	%xmm24, %xmm25, %xmm20
	vaddss	%xmm20, %xmm23, %xmm20
	vmulss	%xmm20, %xmm14, %xmm26
	vmulss	%xmm20, %xmm17, %xmm27
	vmulss	%xmm20, %xmm15, %xmm28
	vsubss	%xmm26, %xmm18, %xmm26
	vsubss	%xmm27, %xmm21, %xmm27
	vsubss	%xmm28, %xmm22, %xmm28
	vmulss	%xmm26, %xmm26, %xmm26
	vmulss	%xmm27, %xmm27, %xmm27
	vmulss	%xmm28, %xmm28, %xmm28
	vaddss	%xmm27, %xmm26, %xmm26
	vaddss	%xmm26, %xmm28, %xmm26
	vsubss	%xmm26, %xmm2, %xmm26
	vucomiss	%xmm26, %xmm3
	ja	.LBB0_37
	vmulss	%xmm18, %xmm18, %xmm18
	vmulss	%xmm21, %xmm21, %xmm21
	vmulss	%xmm14, %xmm14, %xmm14
	vmulss	%xmm17, %xmm17, %xmm17
	movabsq	$.LCPI0_11, %rsi
	vaddss	%xmm25, %xmm25, %xmm25
	vaddss	%xmm24, %xmm24, %xmm24
	vmulss	%xmm15, %xmm15, %xmm15
	vsqrtss	%xmm26, %xmm26, %xmm26
	vxorps	(%r11){1to4}, %xmm20, %xmm27
	vaddss	%xmm21, %xmm18, %xmm18
	vaddss	%xmm17, %xmm14, %xmm21
	vmulss	%xmm22, %xmm22, %xmm17
	vaddss	%xmm24, %xmm25, %xmm24
	vaddss	%xmm23, %xmm23, %xmm14
	vaddss	%xmm18, %xmm17, %xmm17
	vaddss	(%rsi), %xmm17, %xmm17
	vaddss	%xmm21, %xmm15, %xmm15
	vaddss	%xmm24, %xmm14, %xmm22
	movabsq	$.LCPI0_12, %rsi
	vmulss	%xmm22, %xmm15, %xmm25
	vsubss	%xmm26, %xmm27, %xmm27
	vsubss	%xmm20, %xmm26, %xmm20
	vmulss	%xmm17, %xmm15, %xmm23
	vmulss	%xmm22, %xmm17, %xmm14
	vmulss	%xmm22, %xmm22, %xmm22
	vmulss	%xmm15, %xmm15, %xmm15
	vmulss	%xmm17, %xmm17, %xmm17
	vmaxss	%xmm27, %xmm19, %xmm19
	vminss	%xmm20, %xmm16, %xmm20
	vaddss	%xmm23, %xmm23, %xmm23
	vaddss	%xmm14, %xmm14, %xmm26
	vaddss	%xmm25, %xmm25, %xmm14
	vaddss	%xmm23, %xmm22, %xmm22
	vmovss	(%rsi), %xmm23
	movl	$1, %esi
	vmulss	%xmm23, %xmm21, %xmm21
	vmulss	%xmm23, %xmm18, %xmm18
	vsubss	%xmm21, %xmm22, %xmm21
	vmulss	%xmm19, %xmm15, %xmm22
	vsubss	%xmm18, %xmm17, %xmm17
	vmulss	%xmm23, %xmm24, %xmm18
	vaddss	%xmm22, %xmm14, %xmm23
	vsubss	%xmm18, %xmm26, %xmm18
	vaddss	%xmm23, %xmm22, %xmm22
	vmulss	%xmm23, %xmm19, %xmm23
	vaddss	%xmm23, %xmm21, %xmm23
	vmulss	%xmm22, %xmm19, %xmm22
	vaddss	%xmm23, %xmm22, %xmm22
	vmulss	%xmm23, %xmm19, %xmm23
	vaddss	%xmm23, %xmm18, %xmm23
	vmulss	%xmm22, %xmm19, %xmm22
	vaddss	%xmm23, %xmm22, %xmm24
	vmulss	%xmm23, %xmm19, %xmm22
	vaddss	%xmm22, %xmm17, %xmm22
	vmovaps	%xmm22, %xmm23
	.p2align	4
.LBB0_23:
	vucomiss	%xmm3, %xmm24
	jne	.LBB0_25
	jp	.LBB0_25
	vmovss	(%r15), %xmm24
	jmp	.LBB0_26
	.p2align	4
.LBB0_25:
	vxorps	(%r11){1to4}, %xmm23, %xmm25
	vdivss	%xmm24, %xmm25, %xmm24
	vmaxss	(%r13), %xmm24, %xmm24
	vminss	(%r15), %xmm24, %xmm24
.LBB0_26:
	vucomiss	%xmm22, %xmm3
	setbe	%bl
	vucomiss	%xmm23, %xmm3
	seta	%r14b
	cmpb	%bl, %r14b
	je	.LBB0_28
	vandps	%xmm5, %xmm24, %xmm23
	jmp	.LBB0_29
	.p2align	4
.LBB0_28:
	vorps	(%r11){1to4}, %xmm24, %xmm23
.LBB0_29:
	vaddss	%xmm23, %xmm19, %xmm19
	vucomiss	%xmm20, %xmm19
	ja	.LBB0_30
	vmovss	(%r12), %xmm24
	vandps	%xmm5, %xmm23, %xmm23
	vucomiss	%xmm23, %xmm24
	ja	.LBB0_32
	cmpl	$100, %esi
	je	.LBB0_34
	vmulss	%xmm19, %xmm15, %xmm23
	incl	%esi
	vaddss	%xmm23, %xmm14, %xmm24
	vaddss	%xmm24, %xmm23, %xmm23
	vmulss	%xmm24, %xmm19, %xmm24
	vaddss	%xmm24, %xmm21, %xmm24
	vmulss	%xmm23, %xmm19, %xmm23
	vaddss	%xmm24, %xmm23, %xmm23
	vmulss	%xmm24, %xmm19, %xmm24
	vaddss	%xmm24, %xmm18, %xmm25
	vmulss	%xmm23, %xmm19, %xmm23
	vaddss	%xmm25, %xmm23, %xmm24
	vmulss	%xmm25, %xmm19, %xmm23
	vaddss	%xmm23, %xmm17, %xmm23
	jmp	.LBB0_23
.LBB0_32:
	movl	$1, %ebx
	jmp	.LBB0_35
.LBB0_34:
	movl	$100, %esi
	movl	$2, %ebx
.LBB0_35:
	vmovaps	%xmm19, %xmm16
	jmp	.LBB0_36
.LBB0_40:
	leaq	-40(%rbp), %rsp
	popq	%rbx
	popq	%r12
	popq	%r13
	popq	%r14
	popq	%r15
	popq	%rbp
	vzeroupper
	retq
.LBB0_3:
	vcvtsi2ssl	40(%rsp), %xmm15, %xmm0
	movq	16(%rsp), %rax
	movq	8(%rsp), %r14
	vxorps	%xmm12, %xmm12, %xmm12
	vxorps	%xmm14, %xmm14, %xmm14
	vcvtsi2ssl	(%rsp), %xmm15, %xmm1
	vpbroadcastd	%eax, %zmm2
	movabsq	$.LCPI0_0, %rax
	vpaddd	%zmm2, %zmm2, %zmm2
	vmovss	%xmm0, 36(%rsp)
	vpaddd	(%rax), %zmm2, %zmm0
	vmovd	%xmm2, %eax
	vbroadcastss	%xmm1, %zmm1
	vpextrd	$1, %xmm0, %edx
	vmovdqu64	%zmm0, 64(%rsp)
	subl	%eax, %edx
	movabsq	$.LCPI0_1, %rax
	vbroadcastss	(%rax), %zmm2
	movabsq	$.LCPI0_2, %rax
	shll	$4, %edx
	vbroadcastss	(%rax), %zmm5
	movabsq	$.LCPI0_3, %rax
	vpbroadcastd	%edx, %zmm0
	movabsq	$.LCPI0_16, %rdx
	vbroadcastss	(%rax), %zmm6
	movabsq	$.LCPI0_5, %rax
	vmovdqu64	%zmm0, 320(%rsp)
	vbroadcastss	(%rax), %zmm7
	movabsq	$.LCPI0_6, %rax
	vbroadcastss	(%rax), %zmm8
	movabsq	$.LCPI0_7, %rax
	vbroadcastss	(%rax), %zmm9
	movabsq	$.LCPI0_8, %rax
	vbroadcastss	(%rax), %zmm3
	movabsq	$.LCPI0_9, %rax
	vmovups	%zmm2, 256(%rsp)
	vbroadcastss	(%rax), %zmm2
	movabsq	$.LCPI0_4, %rax
	vbroadcastss	(%rax), %zmm13
	movabsq	$.LCPI0_17, %rax
	vmovups	%zmm3, 192(%rsp)
	vmovups	%zmm2, 128(%rsp)
	jmp	.LBB0_4
	.p2align	4
.LBB0_10:
	movq	56(%rsp), %r14
	incq	%r14
	cmpq	24(%rsp), %r14
	je	.LBB0_11
.LBB0_4:
	vmovss	36(%rsp), %xmm3
	leal	1(%r14,%r14), %esi
	vmovdqu64	64(%rsp), %zmm16
	movq	(%rsp), %rbx
	movq	%r14, 56(%rsp)
	imull	%r14d, %ebx
	movq	16(%rsp), %r14
	vcvtsi2ss	%esi, %xmm15, %xmm2
	vsubss	%xmm2, %xmm3, %xmm2
	vdivss	%xmm3, %xmm2, %xmm15
	jmp	.LBB0_5
	.p2align	4
.LBB0_9:
	vpaddd	320(%rsp), %zmm16, %zmm16
	vcmpnltps	%zmm14, %zmm23, %k2
	vcmpleps	%zmm19, %zmm18, %k3
	leal	(%rbx,%r14), %esi
	addq	$16, %r14
	vmovdqa32	%zmm25, %zmm0 {%k1} {z}
	movslq	%esi, %rsi
	vmovaps	%zmm24, %zmm19 {%k2}
	vmovaps	%zmm19, %zmm18 {%k3}
	vaddps	%zmm18, %zmm17, %zmm2
	vmovups	%zmm2, (%r9,%rsi,4)
	vmovdqu64	%zmm0, (%rdi,%rsi,4)
	cmpq	%r10, %r14
	je	.LBB0_10
.LBB0_5:
	vpord	256(%rsp), %zmm16, %zmm2
	vmulss	36(%r8), %xmm15, %xmm21
	vbroadcastss	(%r8), %zmm23
	vbroadcastss	4(%r8), %zmm19
	vbroadcastss	8(%r8), %zmm18
	vcvtdq2ps	%zmm2, %zmm2
	vbroadcastss	%xmm21, %zmm21
	vsubps	%zmm1, %zmm2, %zmm2
	vdivps	%zmm1, %zmm2, %zmm2
	vmulps	24(%r8){1to16}, %zmm2, %zmm17
	vmulps	28(%r8){1to16}, %zmm2, %zmm20
	vmulps	32(%r8){1to16}, %zmm2, %zmm2
	vaddps	12(%r8){1to16}, %zmm17, %zmm17
	vaddps	16(%r8){1to16}, %zmm20, %zmm20
	vaddps	20(%r8){1to16}, %zmm2, %zmm2
	vaddps	%zmm21, %zmm17, %zmm17
	vmulss	40(%r8), %xmm15, %xmm21
	vmulps	%zmm17, %zmm17, %zmm0
	vbroadcastss	%xmm21, %zmm21
	vaddps	%zmm21, %zmm20, %zmm20
	vmulss	44(%r8), %xmm15, %xmm21
	vmulps	%zmm20, %zmm20, %zmm22
	vbroadcastss	%xmm21, %zmm21
	vaddps	%zmm21, %zmm2, %zmm2
	vaddps	%zmm22, %zmm0, %zmm21
	vmulps	%zmm2, %zmm2, %zmm0
	vaddps	%zmm21, %zmm0, %zmm21
	vsqrtps	%zmm21, %zmm21
	vdivps	%zmm21, %zmm5, %zmm24
	vmulps	%zmm24, %zmm17, %zmm22
	vsubss	%xmm19, %xmm12, %xmm17
	vmulps	%zmm24, %zmm20, %zmm21
	vmulps	%zmm24, %zmm2, %zmm20
	vsubss	%xmm23, %xmm12, %xmm2
	vsubss	%xmm18, %xmm12, %xmm24
	vbroadcastss	%xmm2, %zmm2
	vbroadcastss	%xmm17, %zmm17
	vbroadcastss	%xmm24, %zmm24
	vmulps	%zmm6, %zmm22, %zmm26
	vmulps	%zmm22, %zmm2, %zmm2
	vmulps	%zmm21, %zmm17, %zmm17
	vmulps	%zmm20, %zmm24, %zmm0
	vsubps	%zmm22, %zmm26, %zmm27
	vaddps	%zmm17, %zmm2, %zmm2
	vsubps	%zmm27, %zmm26, %zmm26
	vaddps	%zmm2, %zmm0, %zmm17
	vsubps	%zmm26, %zmm22, %zmm27
	vmulps	%zmm6, %zmm17, %zmm24
	vmulps	%zmm17, %zmm22, %zmm2
	vsubps	%zmm17, %zmm24, %zmm25
	vaddps	%zmm2, %zmm23, %zmm0
	vsubps	%zmm25, %zmm24, %zmm24
	vmulps	%zmm24, %zmm26, %zmm28
	vsubps	%zmm24, %zmm17, %zmm25
	vmulps	%zmm24, %zmm27, %zmm29
	vsubps	%zmm28, %zmm2, %zmm28
	vmulps	%zmm25, %zmm26, %zmm26
	vmulps	%zmm25, %zmm27, %zmm27
	vsubps	%zmm29, %zmm28, %zmm28
	vsubps	%zmm26, %zmm28, %zmm26
	vsubps	%zmm23, %zmm0, %zmm28
	vsubps	%zmm28, %zmm0, %zmm29
	vsubps	%zmm28, %zmm2, %zmm2
	vsubps	%zmm26, %zmm27, %zmm26
	vsubps	%zmm29, %zmm23, %zmm23
	vaddps	%zmm23, %zmm2, %zmm2
	vmulps	%zmm6, %zmm21, %zmm23
	vsubps	%zmm21, %zmm23, %zmm3
	vaddps	%zmm26, %zmm2, %zmm2
	vsubps	%zmm3, %zmm23, %zmm23
	vaddps	%zmm2, %zmm0, %zmm27
	vmulps	%zmm17, %zmm21, %zmm2
	vmulps	%zmm24, %zmm23, %zmm28
	vsubps	%zmm23, %zmm21, %zmm26
	vmulps	%zmm25, %zmm23, %zmm23
	vaddps	%zmm2, %zmm19, %zmm0
	vmulps	%zmm27, %zmm22, %zmm31
	vmulps	%zmm24, %zmm26, %zmm29
	vsubps	%zmm28, %zmm2, %zmm28
	vmulps	%zmm25, %zmm26, %zmm26
	vsubps	%zmm29, %zmm28, %zmm28
	vsubps	%zmm23, %zmm28, %zmm23
	vsubps	%zmm19, %zmm0, %zmm28
	vsubps	%zmm28, %zmm0, %zmm29
	vsubps	%zmm28, %zmm2, %zmm2
	vsubps	%zmm23, %zmm26, %zmm23
	vsubps	%zmm29, %zmm19, %zmm19
	vaddps	%zmm19, %zmm2, %zmm2
	vmulps	%zmm6, %zmm20, %zmm19
	vsubps	%zmm20, %zmm19, %zmm3
	vaddps	%zmm23, %zmm2, %zmm2
	vsubps	%zmm3, %zmm19, %zmm19
	vaddps	%zmm2, %zmm0, %zmm28
	vmulps	%zmm17, %zmm20, %zmm2
	vandps	%zmm13, %zmm22, %zmm3
	vcmpltps	%zmm7, %zmm3, %k1
	vdivps	%zmm21, %zmm5, %zmm3
	vmulps	%zmm24, %zmm19, %zmm26
	vsubps	%zmm19, %zmm20, %zmm23
	vmulps	%zmm25, %zmm19, %zmm19
	vmulps	%zmm28, %zmm21, %zmm30
	vmulps	%zmm24, %zmm23, %zmm24
	vsubps	%zmm26, %zmm2, %zmm0
	vmulps	%zmm25, %zmm23, %zmm23
	vsubps	%zmm24, %zmm0, %zmm24
	vaddps	%zmm2, %zmm18, %zmm0
	vsubps	%zmm19, %zmm24, %zmm19
	vsubps	%zmm18, %zmm0, %zmm24
	vsubps	%zmm24, %zmm0, %zmm25
	vsubps	%zmm24, %zmm2, %zmm2
	vsubps	%zmm19, %zmm23, %zmm19
	vxorps	%xmm24, %xmm24, %xmm24
	vsubps	%zmm28, %zmm24, %zmm23
	vsubps	%zmm25, %zmm18, %zmm18
	vandps	%zmm13, %zmm28, %zmm25
	vaddps	%zmm5, %zmm25, %zmm25
	vaddps	%zmm18, %zmm2, %zmm2
	vsubps	%zmm27, %zmm24, %zmm18
	vmulps	%zmm9, %zmm25, %zmm25
	vaddps	%zmm19, %zmm2, %zmm2
	vandps	%zmm13, %zmm27, %zmm19
	vaddps	%zmm5, %zmm19, %zmm19
	vaddps	%zmm5, %zmm25, %zmm25
	vaddps	%zmm2, %zmm0, %zmm29
	vdivps	%zmm22, %zmm5, %zmm0
	vmulps	%zmm9, %zmm19, %zmm19
	vaddps	%zmm5, %zmm19, %zmm19
	vmovaps	%zmm8, %zmm0 {%k1}
	vandps	%zmm13, %zmm0, %zmm2
	vmulps	%zmm18, %zmm0, %zmm18
	vandps	%zmm13, %zmm21, %zmm0
	vmulps	%zmm19, %zmm2, %zmm2
	vcmpltps	%zmm7, %zmm0, %k1
	vandps	%zmm13, %zmm20, %zmm0
	vmovaps	%zmm8, %zmm3 {%k1}
	vcmpltps	%zmm7, %zmm0, %k1
	vmovups	192(%rsp), %zmm0
	vmulps	%zmm23, %zmm3, %zmm23
	vsubps	%zmm2, %zmm18, %zmm19
	vaddps	%zmm18, %zmm2, %zmm2
	vandps	%zmm13, %zmm3, %zmm18
	vdivps	%zmm20, %zmm5, %zmm3
	vmulps	%zmm25, %zmm18, %zmm18
	vsubps	%zmm18, %zmm23, %zmm25
	vaddps	%zmm23, %zmm18, %zmm18
	vsubps	%zmm29, %zmm24, %zmm23
	vmaxps	%zmm25, %zmm19, %zmm19
	vandps	%zmm13, %zmm29, %zmm25
	vminps	%zmm18, %zmm2, %zmm2
	vaddps	%zmm0, %zmm25, %zmm25
	vmulps	%zmm9, %zmm25, %zmm25
	vmovaps	%zmm8, %zmm3 {%k1}
	vandps	%zmm13, %zmm3, %zmm18
	vmulps	%zmm3, %zmm23, %zmm23
	vaddps	%zmm0, %zmm25, %zmm25
	vsubps	%zmm17, %zmm24, %zmm0
	vmulps	%zmm25, %zmm18, %zmm18
	vsubps	%zmm18, %zmm23, %zmm25
	vaddps	%zmm18, %zmm23, %zmm18
	vaddps	%zmm30, %zmm31, %zmm23
	vmaxps	%zmm25, %zmm19, %zmm19
	vminps	%zmm18, %zmm2, %zmm2
	vmaxps	%zmm0, %zmm19, %zmm18
	vmovups	128(%rsp), %zmm0
	vsubps	%zmm17, %zmm0, %zmm0
	vminps	%zmm0, %zmm2, %zmm19
	vmulps	%zmm29, %zmm20, %zmm2
	vaddps	%zmm23, %zmm2, %zmm26
	vmulps	%zmm26, %zmm22, %zmm23
	vmulps	%zmm26, %zmm21, %zmm25
	vmulps	%zmm26, %zmm20, %zmm0
	vsubps	%zmm23, %zmm27, %zmm23
	vsubps	%zmm25, %zmm28, %zmm25
	vsubps	%zmm0, %zmm29, %zmm0
	vmulps	%zmm23, %zmm23, %zmm23
	vmulps	%zmm25, %zmm25, %zmm25
	vmulps	%zmm0, %zmm0, %zmm0
	vaddps	%zmm25, %zmm23, %zmm23
	vxorps	%xmm25, %xmm25, %xmm25
	vaddps	%zmm23, %zmm0, %zmm0
	vsubps	%zmm0, %zmm5, %zmm23
	vcmpnltps	%zmm24, %zmm23, %k2
	vcmpleps	%zmm19, %zmm18, %k1 {%k2}
	kortestw	%k1, %k1
	je	.LBB0_9
	vsqrtps	%zmm23, %zmm24 {%k1} {z}
	vxorps	(%r11){1to16}, %zmm26, %zmm0
	vmovdqa32	%zmm18, %zmm11 {%k1} {z}
	vaddps	%zmm31, %zmm31, %zmm4
	vmulps	%zmm22, %zmm22, %zmm22
	vmulps	%zmm21, %zmm21, %zmm21
	movabsq	$.LCPI0_11, %rsi
	vaddps	%zmm2, %zmm2, %zmm2
	vmulps	%zmm20, %zmm20, %zmm20
	vsubps	%zmm24, %zmm0, %zmm0
	vsubps	%zmm26, %zmm24, %zmm3
	vaddps	%zmm30, %zmm30, %zmm24
	vmovdqa32	%zmm0, %zmm25 {%k1} {z}
	vcmpltps	%zmm11, %zmm25, %k3
	vmovdqa32	%zmm3, %zmm26 {%k1} {z}
	vmulps	%zmm28, %zmm28, %zmm3
	vaddps	%zmm24, %zmm4, %zmm0
	vaddps	%zmm21, %zmm22, %zmm4
	vmovdqa32	%zmm11, %zmm25 {%k3}
	vmovdqa32	%zmm19, %zmm11 {%k1} {z}
	vcmpltps	%zmm26, %zmm11, %k3
	vaddps	%zmm0, %zmm2, %zmm2
	vaddps	%zmm4, %zmm20, %zmm22
	vmovdqa32	%zmm11, %zmm26 {%k3}
	vmulps	%zmm27, %zmm27, %zmm11
	vmulps	%zmm2, %zmm22, %zmm28
	vaddps	%zmm3, %zmm11, %zmm11
	vmulps	%zmm29, %zmm29, %zmm3
	vaddps	%zmm11, %zmm3, %zmm21
	vaddps	(%rsi){1to16}, %zmm21, %zmm21
	movabsq	$.LCPI0_12, %rsi
	vbroadcastss	(%rsi), %zmm30
	movl	$1, %esi
	vmulps	%zmm2, %zmm21, %zmm20
	vmulps	%zmm21, %zmm22, %zmm27
	vmulps	%zmm2, %zmm2, %zmm2
	vmulps	%zmm30, %zmm11, %zmm11
	vmulps	%zmm30, %zmm4, %zmm3
	vmulps	%zmm30, %zmm0, %zmm0
	vaddps	%zmm20, %zmm20, %zmm29
	vaddps	%zmm27, %zmm27, %zmm27
	vaddps	%zmm28, %zmm28, %zmm20
	vmulps	%zmm21, %zmm21, %zmm28
	vmulps	%zmm22, %zmm22, %zmm21
	vaddps	%zmm27, %zmm2, %zmm2
	vmulps	%zmm25, %zmm21, %zmm4
	vsubps	%zmm11, %zmm28, %zmm22
	vsubps	%zmm0, %zmm29, %zmm27
	vsubps	%zmm3, %zmm2, %zmm28
	vaddps	%zmm4, %zmm20, %zmm2
	vaddps	%zmm2, %zmm4, %zmm0
	vmulps	%zmm25, %zmm2, %zmm2
	vaddps	%zmm2, %zmm28, %zmm2
	vmulps	%zmm25, %zmm0, %zmm0
	vaddps	%zmm2, %zmm0, %zmm0
	vmulps	%zmm25, %zmm2, %zmm2
	vaddps	%zmm2, %zmm27, %zmm11
	vmulps	%zmm25, %zmm0, %zmm0
	vmulps	%zmm25, %zmm11, %zmm3
	vaddps	%zmm11, %zmm0, %zmm2
	vaddps	%zmm3, %zmm22, %zmm31
	vcmpnltps	%zmm14, %zmm31, %k0
	.p2align	4
.LBB0_7:
	vbroadcastss	(%r11), %zmm11
	kandw	%k2, %k1, %k3
	vpbroadcastd	%esi, %zmm0
	incl	%esi
	vcmpneqps	%zmm14, %zmm2, %k4 {%k3}
	vpbroadcastd	(%r13), %zmm10 {%k4} {z}
	vpbroadcastd	(%r15), %zmm4 {%k4} {z}
	vxorps	%zmm11, %zmm31, %zmm3
	vdivps	%zmm2, %zmm3, %zmm2
	vmovdqa32	%zmm2, %zmm2 {%k4} {z}
	vcmpltps	%zmm2, %zmm10, %k5
	vmovdqa32	%zmm2, %zmm10 {%k5}
	vcmpltps	%zmm4, %zmm10, %k5
	vmovdqa32	%zmm10, %zmm4 {%k5}
	vcmpltps	%zmm3, %zmm31, %k5
	vpbroadcastd	(%r15), %zmm3
	kxorw	%k0, %k5, %k5
	kandw	%k5, %k3, %k6
	kandnw	%k3, %k5, %k5
	vpandd	%zmm13, %zmm4, %zmm3 {%k4}
	vorps	%zmm11, %zmm3, %zmm11 {%k5}
	vmovaps	%zmm3, %zmm11 {%k6}
	vbroadcastss	(%r12), %zmm3
	vaddps	%zmm11, %zmm25, %zmm25
	vandps	%zmm13, %zmm11, %zmm2
	vmulps	%zmm25, %zmm21, %zmm10
	vcmpnltps	%zmm25, %zmm26, %k4 {%k3}
	vcmpltps	%zmm25, %zmm26, %k3 {%k3}
	vaddps	%zmm10, %zmm20, %zmm4
	vcmpltps	%zmm3, %zmm2, %k6 {%k4}
	vcmpnltps	%zmm3, %zmm2, %k5 {%k4}
	vpbroadcastd	(%rdx), %zmm3
	vaddps	%zmm4, %zmm10, %zmm2
	vmulps	%zmm4, %zmm25, %zmm4
	korw	%k6, %k3, %k3
	vaddps	%zmm4, %zmm28, %zmm4
	vmulps	%zmm2, %zmm25, %zmm2
	vaddps	%zmm4, %zmm2, %zmm2
	vmulps	%zmm4, %zmm25, %zmm4
	vpcmpeqd	%zmm3, %zmm0, %k6 {%k5}
	vmovdqa32	%zmm3, %zmm0 {%k5}
	vpmovm2d	%k4, %zmm3
	vpsrld	$31, %zmm3, %zmm3
	vmovdqa32	%zmm0, %zmm30 {%k2}
	vpbroadcastd	(%rax), %zmm3 {%k5}
	vaddps	%zmm4, %zmm27, %zmm4
	vmulps	%zmm2, %zmm25, %zmm2
	korw	%k3, %k6, %k3
	vaddps	%zmm4, %zmm2, %zmm2
	vmulps	%zmm4, %zmm25, %zmm4
	vaddps	%zmm4, %zmm22, %zmm31
	vblendmps	%zmm25, %zmm19, %zmm4 {%k4}
	vmovaps	%zmm4, %zmm24 {%k2}
	vmovdqa32	%zmm3, %zmm29 {%k2}
	kandnw	%k2, %k3, %k2
	ktestw	%k1, %k2
	jne	.LBB0_7
	vpslld	$2, %zmm30, %zmm0
	vpord	%zmm29, %zmm0, %zmm25
	jmp	.LBB0_9
.Lfunc_end0:
	.size	camera, .Lfunc_end0-camera

	.type	float_const_signMask,@object
	.section	.lrodata,"al",@progbits
	.globl	float_const_signMask
	.p2align	2, 0x0
float_const_signMask:
	.long	2147483647
	.size	float_const_signMask, 4

	.ident	"Intel(R) oneAPI DPC++/C++ Compiler 2026.2.0 (2026.2.0.20261001)"
	.section	".note.GNU-stack","",@progbits
